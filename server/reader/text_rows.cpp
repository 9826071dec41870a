#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/thread_pool.hpp"
#include "ct/read/volume_answer.hpp"
#include "reader/ct_files.hpp"
#include "reader/gray_values.hpp"
#include "reader/row_store.hpp"

namespace ream::reader {
namespace {

using ct::given_words_per_layer;
using Axes = std::array<RowAxis, 3>;

/// A grid may have so many voxels for each row, and this many whatever its rows.
constexpr uint64_t max_voxels_per_row = 2000, always_voxels = 100'000'000;
constexpr int max_row_side = 65535;
constexpr uint64_t dense_bytes = 1'000'000'000;  // of memory for rows, before they go to the disk

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

/// Places the grid; `spacing_mm` from a comment.
void set_grid(HuVolume& volume, Axes& axes, const std::optional<Vec3>& spacing_mm, const std::string& file) {
  double step = 0.0;
  bool whole = true;
  for (const RowAxis& axis : axes) {
    if (axis.count > 1) step = step > 0.0 ? std::min(step, axis.step) : axis.step;
    whole = whole && (axis.count == 1 || axis.step == 1.0) && axis.first == std::floor(axis.first) &&
            axis.first >= 0.0;
  }
  for (int k = 0; k < 3; ++k) {
    RowAxis& axis = axes[static_cast<size_t>(k)];
    double& corner = volume.world_from_volume.translation_mm[k];
    volume.dims[k] = axis.count;
    if (spacing_mm && whole) {
      volume.spacing_mm[k] = (*spacing_mm)[k];
      corner = (axis.first - 0.5) * volume.spacing_mm[k];
      continue;
    }
    if (axis.count == 1 && spacing_mm) axis.step = (*spacing_mm)[k];
    if (axis.count == 1 && !(axis.step > 0.0)) axis.step = step;
    if (!(axis.step > 0.0))
      throw Error(ErrorKind::invalid_input,
                  file +
                      " holds a single voxel, which says nothing of its size; put a line "
                      "'# spacing_mm X Y Z' before it");
    volume.spacing_mm[k] = axis.step;
    corner = axis.first - 0.5 * axis.step;
  }
  if (whole && !spacing_mm && step == 1.0)
    volume.warnings.push_back(
        "the rows give whole numbers, which were taken as mm: voxels of 1 mm; if they are voxel indices, put "
        "a line '# spacing_mm X Y Z' before the rows");
}

void check_size(const Axes& axes, uint64_t rows, const std::string& file) {
  const double voxels = static_cast<double>(axes[0].count) * axes[1].count * axes[2].count;
  const bool sparse = voxels > static_cast<double>(always_voxels) &&
                      voxels > static_cast<double>(max_voxels_per_row) * static_cast<double>(rows);
  const int longest = std::max({axes[0].count, axes[1].count, axes[2].count});
  if (sparse || voxels > max_ct_voxels || longest > max_row_side)
    throw Error(ErrorKind::invalid_input,
                file + " spans " + std::to_string(axes[0].count) + " x " + std::to_string(axes[1].count) +
                    " x " + std::to_string(axes[2].count) + " voxels with " + std::to_string(rows) +
                    " rows only; are some far off? (a volume has at most 1e9 voxels, 65,535 along an axis)");
}

/// The rows of a file on the grid that they make.
class RowGrid {
 public:
  RowGrid(const std::filesystem::path& path, MemoryBudget& budget, const Progress& progress)
      : file_(path.string()), store_(path, budget, progress) {
    if (store_.size() == 0) throw Error(ErrorKind::invalid_input, file_ + " holds no rows 'x y z gray'");
    Axes axes = axes_of(store_, file_);
    check_size(axes, store_.size(), file_);
    std::optional<Vec3> spacing_mm;
    for (size_t t = 0; t < RowStore::threads; ++t)
      if (store_.parser(t).spacing_mm) spacing_mm = store_.parser(t).spacing_mm;
    set_grid(place, axes, spacing_mm, file_);
    place.source = "text rows x y z gray";
    for (size_t t = 0; t < RowStore::threads; ++t)
      for (size_t k = 0; k < 3; ++k)
        for (const RowPlace& at : store_.parser(t).places[k].places())
          index_[t][k].push_back(axes[k].index(at.at));
  }

  uint64_t rows() const { return store_.size(); }
  const std::string& file() const { return file_; }

  voxel::GrayScale gray() const {
    voxel::GrayScaleFinder finder;
    for (size_t t = 0; t < RowStore::threads; ++t) finder.add(store_.parser(t).gray);
    return finder.scale();
  }

  /// Calls use(voxel, gray) for every row, blocks of rows on two threads.
  template <typename Use>
  void each(Use&& use) const {
    parallel_for(2, store_.blocks(), [&](size_t block) {
      each_of(block, [&](const Vec3i& voxel, float gray, size_t) { use(voxel, gray); });
    });
  }

  /// Names the first row whose voxel an earlier one gave.
  [[noreturn]] void refuse_repeated() const {
    std::vector<bool> seen(place.voxel_count());
    for (size_t block = 0; block < store_.blocks(); ++block)
      each_of(block, [&](const Vec3i& o, float, size_t row) {
        const size_t i = place.index(o.x(), o.y(), o.z());
        if (seen[i])
          throw Error(ErrorKind::invalid_input, file_ + " line " +
                                                    std::to_string(store_.line_of_row(block, row)) +
                                                    ": gives a voxel that an earlier line gave already");
        seen[i] = true;
      });
    throw Error(ErrorKind::invalid_input, file_ + " was changed while it was read");
  }

  HuVolume place;  ///< everything but the values

 private:
  template <typename Use>
  void each_of(size_t block, Use&& use) const {
    std::vector<RowRecord> scratch;
    const auto& index = index_[store_.parser_of(block)];
    size_t number = 0;
    for (const RowRecord& row : store_.rows(block, scratch))
      use(Vec3i(index[0][row.place[0]], index[1][row.place[1]], index[2][row.place[2]]), row.gray, number++);
  }

  std::string file_;
  RowStore store_;
  std::array<std::array<std::vector<int>, 3>, RowStore::threads> index_;
};

/// Which voxels have a row: a bit each, a layer in whole words.
class GivenVoxels {
 public:
  GivenVoxels(const RowGrid& grid, MemoryBudget& budget) : dims_(grid.place.dims) {
    budget.take(given_words_per_layer(dims_) * layers() * sizeof(uint64_t), "the grid of " + grid.file());
    words_.resize(given_words_per_layer(dims_) * layers());
    std::atomic<bool> once{true};
    grid.each([&](const Vec3i& o, float) {
      const uint64_t bit = uint64_t{1} << bit_of(o) % 64;
      const std::atomic_ref word(words_[bit_of(o) / 64]);
      if ((word.fetch_or(bit, std::memory_order_relaxed) & bit) != 0) once = false;
    });
    if (!once) grid.refuse_repeated();
    uint64_t sum = 0;
    for (size_t i = 0; i < words_.size(); ++i) {
      if (i % counted_words == 0) before_.push_back(sum);
      sum += static_cast<uint64_t>(std::popcount(words_[i]));
    }
    before_.push_back(sum);
  }

  /// How many given voxels come before it.
  uint64_t number_of(const Vec3i& o) const {
    const uint64_t at = bit_of(o), word = at / 64;
    return before_word(word) +
           static_cast<uint64_t>(std::popcount(words_[word] & ((uint64_t{1} << at % 64) - 1)));
  }
  uint64_t before_layer(int w) const {
    return before_word(static_cast<uint64_t>(w) * given_words_per_layer(dims_));
  }
  const std::vector<uint64_t>& words() const { return words_; }

 private:
  static constexpr size_t counted_words = 8;

  size_t layers() const { return static_cast<size_t>(dims_.z()); }
  uint64_t bit_of(const Vec3i& o) const {
    return 64 * given_words_per_layer(dims_) * static_cast<uint64_t>(o.z()) +
           static_cast<uint64_t>(o.y()) * static_cast<uint64_t>(dims_.x()) + static_cast<uint64_t>(o.x());
  }
  uint64_t before_word(uint64_t word) const {
    if (word == words_.size()) return before_.back();
    uint64_t sum = before_[word / counted_words];
    for (uint64_t i = word - word % counted_words; i < word; ++i)
      sum += static_cast<uint64_t>(std::popcount(words_[i]));
    return sum;
  }

  Vec3i dims_;
  std::vector<uint64_t> words_, before_;
};

}  // namespace

GrayValues write_row_values(const std::filesystem::path& path, const std::filesystem::path& given_file,
                            const std::filesystem::path& values_file, uint64_t max_bytes,
                            const Progress& progress) {
  MemoryBudget budget = MemoryBudget::with_left(max_bytes, ".");
  RowGrid grid(path, budget, progress);
  GrayValues result{{}, grid.gray()};
  const GivenVoxels given(grid, budget);
  ct::write_values(given_file, given.words().data(),
                   given.words().size() * sizeof(uint64_t) / sizeof(uint16_t));
  const int layers = grid.place.dims.z();
  std::vector<uint16_t> codes;
  for (int first = 0, end = 0; first < layers; first = end) {
    const uint64_t before = given.before_layer(first);
    for (end = first + 1; end < layers; ++end)
      if ((given.before_layer(end + 1) - before) * sizeof(uint16_t) > budget.left() / 2) break;
    codes.resize(given.before_layer(end) - before);
    grid.each([&](const Vec3i& o, float gray) {
      if (o.z() >= first && o.z() < end)
        codes[given.number_of(o) - before] = result.gray.code(static_cast<double>(gray));
    });
    ct::write_values(values_file, codes.data(), codes.size());
  }
  result.place = std::move(grid.place);
  return result;
}

HuVolume read_text_rows(const std::filesystem::path& path, const Progress& progress) {
  MemoryBudget budget(dense_bytes, ".");
  RowGrid grid(path, budget, progress);
  HuVolume volume = grid.place;
  for (int k = 0; k < 3; ++k)
    if (volume.dims[k] < 2)
      throw Error(ErrorKind::invalid_input, grid.file() + " has a single " + "xyz"[k] +
                                                "; a volume has at least two voxels along each axis");
  // Before memory is taken: a few far rows must not claim a large grid.
  if (grid.rows() < volume.voxel_count() / 2)
    throw Error(ErrorKind::invalid_input, grid.file() + " has " + std::to_string(grid.rows()) +
                                              " rows for a grid of " + std::to_string(volume.voxel_count()) +
                                              " voxels; every voxel needs one");
  volume.hu.assign(volume.voxel_count(), 0);
  std::vector<uint8_t> seen(volume.voxel_count());
  std::atomic<bool> once{true};
  grid.each([&](const Vec3i& o, float gray) {
    const size_t i = volume.index(o.x(), o.y(), o.z());
    if (std::atomic_ref(seen[i]).exchange(1, std::memory_order_relaxed) != 0)
      once = false;
    else
      volume.hu[i] = static_cast<int16_t>(std::clamp(std::floor(gray + 0.5f), -32768.0f, 32767.0f));
  });
  if (!once) grid.refuse_repeated();
  const auto hole = static_cast<size_t>(std::find(seen.begin(), seen.end(), 0) - seen.begin());
  progress(1.0, "reading rows");
  if (hole == seen.size()) return volume;
  const auto nx = static_cast<size_t>(volume.dims.x()), ny = static_cast<size_t>(volume.dims.y());
  throw Error(ErrorKind::invalid_input, grid.file() + ": no row gives voxel " + std::to_string(hole % nx) +
                                            " " + std::to_string(hole / nx % ny) + " " +
                                            std::to_string(hole / nx / ny) + " of the grid");
}

}  // namespace ream::reader
