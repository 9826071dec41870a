#include "fe/element_model.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/progress.hpp"
#include "core/thread_pool.hpp"
#include "fe/memory_budget.hpp"
#include "fe/row_parser.hpp"

namespace ream::fe {
namespace {

/// All rows of a text file, read once on two threads, in its order.
class RowStore {
 public:
  /// Throws Error not_found, io, cancelled, or invalid_input naming the first line that is no row.
  RowStore(const std::filesystem::path& path, MemoryBudget& budget, const Progress& progress);
  ~RowStore();
  RowStore(const RowStore&) = delete;
  RowStore& operator=(const RowStore&) = delete;

  uint64_t size() const { return size_; }
  const RowParser& parser(size_t thread) const { return parsers_[thread]; }
  static constexpr size_t threads = 2;

  /// The file lies here in blocks, each read by one of the parsers.
  size_t blocks() const { return blocks_.size(); }
  size_t parser_of(size_t block) const { return blocks_[block].parser; }
  /// Valid until `scratch` changes. Thread-safe.
  std::span<const RowRecord> rows(size_t block, std::vector<RowRecord>& scratch) const;

  /// The line of a place in the file, and of a row of a block; read anew.
  uint64_t line_of_byte(uint64_t byte) const;
  uint64_t line_of_row(size_t block, size_t row) const;

 private:
  struct Block {
    size_t parser = 0;
    uint64_t first_row = 0;  ///< in the order of keeping, of those on the disk
    size_t count = 0;
    std::vector<RowRecord> rows;
  };
  void read_block(size_t block, std::vector<char>& text, const char*& begin, const char*& end,
                  uint64_t& byte) const;
  void keep(size_t block, std::vector<RowRecord>&& rows);

  MemoryBudget& budget_;
  std::filesystem::path path_;
  FileDescriptor file_;
  uint64_t file_bytes_ = 0, size_ = 0;
  std::vector<RowParser> parsers_;
  std::vector<Block> blocks_;
  std::unique_ptr<SpillFile> spill_;
  uint64_t spilled_ = 0;
  std::mutex mutex_;
};

namespace fs = std::filesystem;

constexpr uint64_t block_bytes = 4 << 20;
constexpr uint64_t short_row_bytes = 16;  // to guess how many rows there can be
constexpr size_t readable_behind = 64;

RowStore::RowStore(const fs::path& path, MemoryBudget& budget, const Progress& progress)
    : budget_(budget), path_(path), parsers_(threads) {
  if (!fs::is_regular_file(path)) throw Error(ErrorKind::not_found, "no such file: " + path.string());
  file_ = FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file_) throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + std::strerror(errno));
  file_bytes_ = fs::file_size(path);
  blocks_.resize((file_bytes_ + block_bytes - 1) / block_bytes);
  if (!budget.fits(2 * file_bytes_ / short_row_bytes * sizeof(RowRecord)))
    spill_ = std::make_unique<SpillFile>(budget.folder());
  std::mutex mutex;
  std::optional<RowFault> first_fault;
  std::vector<bool> busy(threads);
  const auto work = [&](size_t block) {
    size_t parser = 0;
    {
      const std::lock_guard lock(mutex);
      if (first_fault && first_fault->byte < block * block_bytes) return;
      parser = busy[0] ? 1 : 0;
      busy[parser] = true;
    }
    std::vector<char> text;
    std::vector<RowRecord> rows;
    const char *begin = nullptr, *end = nullptr;
    uint64_t byte = 0;
    read_block(block, text, begin, end, byte);
    rows.reserve(text.size() / 40);
    const auto fault = parsers_[parser].parse(begin, end, byte, rows);
    blocks_[block].parser = parser;
    keep(block, std::move(rows));
    const std::lock_guard lock(mutex);
    busy[parser] = false;
    if (fault && (!first_fault || fault->byte < first_fault->byte)) first_fault = fault;
  };
  parallel_for(2, blocks_.size(), work, progress, "reading rows");
  if (first_fault)
    throw Error(ErrorKind::invalid_input, path_.string() + " line " +
                                              std::to_string(line_of_byte(first_fault->byte)) + ": " +
                                              first_fault->why);
  for (const Block& block : blocks_) size_ += block.count;
  if (!spill_) budget.take(size_ * sizeof(RowRecord), "reading " + path.string());
}

RowStore::~RowStore() {
  if (!spill_) budget_.give_back(size_ * sizeof(RowRecord));
}

/// The lines that begin in the block, the last of them whole.
void RowStore::read_block(size_t block, std::vector<char>& text, const char*& begin, const char*& end,
                          uint64_t& byte) const {
  const uint64_t first = block * block_bytes, from = first == 0 ? 0 : first - 1;
  const uint64_t to = std::min(file_bytes_, first + block_bytes + RowParser::max_line_bytes);
  text.resize(to - from + 1 + readable_behind);
  const ssize_t got = file_.read_at(from, std::as_writable_bytes(std::span(text).first(to - from)));
  if (got < 0 || static_cast<uint64_t>(got) < to - from)
    throw Error(ErrorKind::io,
                "cannot read " + path_.string() +
                    (got < 0 ? std::string(": ") + std::strerror(errno) : ", it was cut short"));
  const char* const all = text.data() + (to - from);
  text[to - from] = '\n';  // ends the last line, and any search
  begin = text.data();
  byte = from;
  if (first > 0) {
    begin = static_cast<const char*>(std::memchr(begin, '\n', static_cast<size_t>(all - begin) + 1)) + 1;
    byte += static_cast<uint64_t>(begin - text.data());
  }
  end = std::min(all, static_cast<const char*>(text.data()) + (first - from) + block_bytes);
  if (end == all) return;
  // The line that begins last must end in what was read.
  if (std::memchr(end, '\n', static_cast<size_t>(all - end)) == nullptr)
    throw Error(ErrorKind::invalid_input,
                path_.string() + " line " +
                    std::to_string(line_of_byte(from + static_cast<uint64_t>(end - text.data()))) +
                    ": is too long for 'x y z gray'");
}

void RowStore::keep(size_t block, std::vector<RowRecord>&& rows) {
  blocks_[block].count = rows.size();
  if (!spill_) {
    rows.shrink_to_fit();
    blocks_[block].rows = std::move(rows);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    blocks_[block].first_row = spilled_;
    spilled_ += rows.size();
  }
  spill_->write_at(blocks_[block].first_row * sizeof(RowRecord), std::as_bytes(std::span(rows)));
}

std::span<const RowRecord> RowStore::rows(size_t block, std::vector<RowRecord>& scratch) const {
  const Block& b = blocks_[block];
  if (!spill_) return b.rows;
  scratch.resize(b.count);
  spill_->read_at(b.first_row * sizeof(RowRecord), std::as_writable_bytes(std::span(scratch)));
  return scratch;
}

uint64_t RowStore::line_of_byte(uint64_t byte) const {
  uint64_t line = 1;
  std::vector<char> text(block_bytes);
  for (uint64_t at = 0; at < byte;) {
    const ssize_t n = file_.read_at(
        at, std::as_writable_bytes(std::span(text).first(std::min<uint64_t>(text.size(), byte - at))));
    if (n <= 0) break;
    line += static_cast<uint64_t>(std::count(text.begin(), text.begin() + n, '\n'));
    at += static_cast<uint64_t>(n);
  }
  return line;
}

uint64_t RowStore::line_of_row(size_t block, size_t row) const {
  std::vector<char> text;
  const char *begin = nullptr, *end = nullptr;
  uint64_t byte = 0;
  read_block(block, text, begin, end, byte);
  RowParser parser;
  std::vector<RowRecord> rows;
  std::vector<uint64_t> bytes;
  parser.parse(begin, end, byte, rows, &bytes);
  return line_of_byte(bytes.at(row));
}

using Axes = std::array<RowAxis, 3>;

/// A grid may have so many voxels for each row, and this many whatever its rows.
constexpr uint64_t max_voxels_per_row = 2000, always_voxels = 100'000'000;

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
      voxels > static_cast<double>(max_voxels_per_row) * static_cast<double>(rows))
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
    parallel_for(2, store_.blocks(), [&](size_t block) {
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
  parallel_for(2, store.blocks(), [&](size_t block) {
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
