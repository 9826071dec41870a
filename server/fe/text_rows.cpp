#include "fe/text_rows.hpp"

#include <array>
#include <atomic>
#include <numeric>

#include "core/error.hpp"
#include "fe/row_store.hpp"
#include "fe/two_threads.hpp"

namespace ream::fe {
namespace {

using Axes = std::array<RowAxis, 3>;

/// A grid may have so many voxels for each row, and this many whatever its rows.
constexpr uint64_t most_voxels_per_row = 2000, always_voxels = 100'000'000;

Axes axes_of(const RowStore& store, const std::string& file) {
  Axes axes;
  for (size_t k = 0; k < 3; ++k) {
    std::vector<RowPlace> places;
    for (size_t t = 0; t < RowStore::threads; ++t)
      for (const RowPlace& place : store.parser(t).places[k].places()) places.push_back(place);
    std::optional<RowPlace> off;
    axes[k] = axis_of(std::move(places), off);
    if (off)
      throw Error(ErrorKind::invalid_input,
                  file + " line " + std::to_string(store.line_of_byte(off->first_byte)) + ": its " +
                      "xyz"[k] + " lies on no regular grid with the others");
  }
  return axes;
}

/// Places the grid of the model; `spacing_mm` from a comment.
void set_grid(ElementModel& model, Axes& axes, const std::optional<Vec3>& spacing_mm,
              const std::string& file) {
  double step = 0.0;
  bool whole = true;
  for (const RowAxis& axis : axes) {
    if (axis.count > 1) step = step > 0.0 ? std::min(step, axis.step) : axis.step;
    whole = whole && (axis.count == 1 || axis.step == 1.0) && axis.first == std::floor(axis.first) &&
            axis.first >= 0.0;
  }
  for (int k = 0; k < 3; ++k) {
    RowAxis& axis = axes[static_cast<size_t>(k)];
    if (spacing_mm && whole) {
      model.spacing_mm[k] = (*spacing_mm)[k];
      model.origin_mm[k] = (axis.first - 0.5) * model.spacing_mm[k];
      continue;
    }
    if (axis.count == 1 && spacing_mm) axis.step = (*spacing_mm)[k];
    if (axis.count == 1 && !(axis.step > 0.0)) axis.step = step;
    if (!(axis.step > 0.0))
      throw Error(ErrorKind::invalid_input,
                  file +
                      " holds a single voxel, which says nothing of its size; put a line "
                      "'# spacing_mm X Y Z' before it");
    model.spacing_mm[k] = axis.step;
    model.origin_mm[k] = axis.first - 0.5 * axis.step;
  }
  if (whole && !spacing_mm && step == 1.0)
    model.remarks.push_back(
        "the rows give whole numbers, which were taken as mm: voxels of 1 mm; if they are voxel indices, put "
        "a "
        "line '# spacing_mm X Y Z' before the rows");
}

void check_size(const Axes& axes, uint64_t rows, const std::string& file) {
  const double voxels = static_cast<double>(axes[0].count) * axes[1].count * axes[2].count;
  if (voxels > static_cast<double>(always_voxels) &&
      voxels > static_cast<double>(most_voxels_per_row) * static_cast<double>(rows))
    throw Error(ErrorKind::invalid_input, file + " spans " + std::to_string(axes[0].count) + " x " +
                                              std::to_string(axes[1].count) + " x " +
                                              std::to_string(axes[2].count) + " voxels with " +
                                              std::to_string(rows) + " rows only; are some far off?");
}

/// Turns rows into voxels of the grid.
class Placing {
 public:
  Placing(const RowStore& store, const Axes& axes) : store_(store) {
    for (size_t t = 0; t < RowStore::threads; ++t)
      for (size_t k = 0; k < 3; ++k)
        for (const RowPlace& place : store.parser(t).places[k].places())
          index_[t][k].push_back(axes[k].index(place.at));
  }

  /// Calls use(u, v, w, gray, row in the block).
  template <typename Use>
  void each(size_t block, Use&& use) const {
    std::vector<RowRecord> scratch;
    const auto& index = index_[store_.parser_of(block)];
    size_t number = 0;
    for (const RowRecord& row : store_.rows(block, scratch))
      use(index[0][row.place[0]], index[1][row.place[1]], index[2][row.place[2]], row.gray, number++);
  }

  /// False when a voxel was given twice.
  bool mark(VoxelMask& mask) const {
    std::atomic<bool> once{true};
    on_two_threads(store_.blocks(), [&](size_t block) {
      each(block, [&](int u, int v, int w, float, size_t) {
        const uint64_t bit = uint64_t{1} << (u % 64);
        const uint64_t old = std::atomic_ref(mask.row(v, w)[u / 64]).fetch_or(bit, std::memory_order_relaxed);
        if ((old & bit) != 0) once = false;
      });
    });
    return once;
  }

  [[noreturn]] void refuse_repeated(const Vec3i& dims, const std::string& file) const {
    VoxelMask seen(dims);
    for (size_t block = 0; block < store_.blocks(); ++block)
      each(block, [&](int u, int v, int w, float, size_t row) {
        if (seen.at(u, v, w))
          throw Error(ErrorKind::invalid_input, file + " line " +
                                                    std::to_string(store_.line_of_row(block, row)) +
                                                    ": gives a voxel that an earlier line gave already");
        seen.set(u, v, w);
      });
    throw Error(ErrorKind::invalid_input, file + " was changed while it was read");
  }

 private:
  const RowStore& store_;
  std::array<std::array<std::vector<int>, 3>, RowStore::threads> index_;
};

/// Puts the gray codes of layers [first, end) into `codes`, in the order of their elements.
void place_codes(const RowStore& store, const Placing& placing, const VoxelMask& mask,
                 const std::vector<uint64_t>& before_row, const voxel::GrayScale& gray, int first, int end,
                 std::span<uint16_t> codes) {
  const auto rows_per_layer = static_cast<size_t>(mask.dims().y());
  const uint64_t before = before_row[static_cast<size_t>(first) * rows_per_layer];
  on_two_threads(store.blocks(), [&](size_t block) {
    placing.each(block, [&](int u, int v, int w, float value, size_t) {
      if (w < first || w >= end) return;
      const uint64_t* row = mask.row(v, w);
      uint64_t element = before_row[static_cast<size_t>(v) + rows_per_layer * static_cast<size_t>(w)];
      element += set_bits(row, static_cast<size_t>(u) / 64) +
                 static_cast<size_t>(std::popcount(row[u / 64] & ((uint64_t{1} << (u % 64)) - 1)));
      codes[element - before] = gray.code(static_cast<double>(value));
    });
  });
}

/// All at once, or as many layers at a time as there is room for.
void place_all(const RowStore& store, const Placing& placing, ElementModel& model, MemoryBudget& budget) {
  const VoxelMask& mask = model.mask;
  std::vector<uint64_t> before_row(
      static_cast<size_t>(mask.dims().y()) * static_cast<size_t>(mask.dims().z()) + 1);
  for (size_t i = 0; i + 1 < before_row.size(); ++i)
    before_row[i + 1] =
        before_row[i] + set_bits(mask.row(0, 0) + i * mask.words_per_row(), mask.words_per_row());
  model.codes = ElementCodes(store.size(), budget);
  if (model.codes.in_memory()) {
    place_codes(store, placing, mask, before_row, model.gray, 0, mask.dims().z(), model.codes.all());
    return;
  }
  const auto rows_per_layer = static_cast<size_t>(mask.dims().y());
  const auto before_layer = [&](int w) { return before_row[static_cast<size_t>(w) * rows_per_layer]; };
  std::vector<uint16_t> window;
  for (int first = 0; first < mask.dims().z();) {
    int end = first + 1;
    while (end < mask.dims().z() &&
           (before_layer(end + 1) - before_layer(first)) * sizeof(uint16_t) <= budget.left() / 2)
      ++end;
    window.resize(before_layer(end) - before_layer(first));
    place_codes(store, placing, mask, before_row, model.gray, first, end, window);
    model.codes.write(before_layer(first), window);
    first = end;
  }
}

}  // namespace

ElementModel read_text_rows(const std::filesystem::path& path, MemoryBudget& budget,
                            const Progress& progress) {
  const std::string file = path.string();
  const RowStore store(path, budget, progress);
  if (store.size() == 0) throw Error(ErrorKind::invalid_input, file + " holds no rows 'x y z gray'");
  Axes axes = axes_of(store, file);
  check_size(axes, store.size(), file);
  ElementModel model;
  voxel::GrayScaleFinder gray;
  std::optional<Vec3> spacing_mm;
  for (size_t t = 0; t < RowStore::threads; ++t) {
    gray.add(store.parser(t).gray);
    if (store.parser(t).spacing_mm) spacing_mm = store.parser(t).spacing_mm;
  }
  model.gray = gray.scale();
  if (!model.gray.exact)
    model.remarks.push_back("gray values were rounded to 65,536 steps between the least and the greatest");
  set_grid(model, axes, spacing_mm, file);
  const Placing placing(store, axes);
  const Vec3i dims(axes[0].count, axes[1].count, axes[2].count);
  budget.take(VoxelMask::bytes_of(dims), "the grid of " + file);
  model.mask = VoxelMask(dims);
  if (!placing.mark(model.mask)) placing.refuse_repeated(dims, file);
  place_all(store, placing, model, budget);
  model.source = "text rows x y z gray";
  return model;
}

}  // namespace ream::fe
