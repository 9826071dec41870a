#include "reader/ct_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>

#include "core/error.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr size_t piece_bytes = 1 << 20;
constexpr size_t max_line_bytes = 4096;
constexpr size_t max_places = 8192;           // along one axis
constexpr double gap_tolerance = 0.08;        // of a voxel, for positions rounded when written
constexpr double same_place = 1e-3;           // of a voxel: two ways to write one position
constexpr uint64_t progress_every = 1 << 16;  // lines

struct Row {
  std::array<double, 3> at{};
  double gray = 0.0;
  uint64_t line = 0;
};

bool separates(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

/// Numbers at the start of a line; false when there are fewer or something else follows.
template <size_t count>
bool parse_numbers(const char* from, const char* end, std::array<double, count>& numbers) {
  for (double& number : numbers) {
    while (from != end && separates(*from)) ++from;
    const auto parsed = std::from_chars(from, end, number);
    if (parsed.ec != std::errc() || !std::isfinite(number)) return false;
    from = parsed.ptr;
    if (from != end && !separates(*from)) return false;
  }
  while (from != end && separates(*from)) ++from;
  return from == end;
}

/// A text file in pieces.
class Rows {
 public:
  Rows(const fs::path& path, const Progress& progress)
      : path_(path), progress_(progress), in_(path, std::ios::binary), size_(fs::file_size(path)) {
    if (!in_) throw Error(ErrorKind::io, "cannot read " + path.string());
  }

  Error wrong(uint64_t line, const std::string& why) const {
    return {ErrorKind::invalid_input, path_.string() + " line " + std::to_string(line) + ": " + why};
  }

  /// Calls use(row) for every row.
  template <typename Use>
  void each(Use&& use) {
    std::string text;
    while (in_) {
      const size_t kept = text.size();
      text.resize(kept + piece_bytes);
      in_.read(text.data() + kept, static_cast<std::streamsize>(piece_bytes));
      text.resize(kept + static_cast<size_t>(in_.gcount()));
      read_ += static_cast<uint64_t>(in_.gcount());
      if (!in_ && !text.empty() && text.back() != '\n') text += '\n';
      const char *at = text.data(), *end = at + text.size();
      while (const char* stop =
                 static_cast<const char*>(std::memchr(at, '\n', static_cast<size_t>(end - at)))) {
        line(at, stop, use);
        at = stop + 1;
      }
      text.erase(0, static_cast<size_t>(at - text.data()));
      if (text.size() > max_line_bytes) throw wrong(line_ + 1, "is too long for 'x y z gray'");
    }
  }

  std::optional<Vec3> spacing_mm;  ///< from a comment

 private:
  template <typename Use>
  void line(const char* from, const char* end, Use&& use) {
    ++line_;
    if (line_ % progress_every == 0)
      progress_(static_cast<double>(read_) / static_cast<double>(size_), "reading rows");
    while (from != end && separates(*from)) ++from;
    if (from == end) return;
    if (*from == '#') return comment(from, end);
    std::array<double, 4> numbers{};
    if (!parse_numbers(from, end, numbers)) throw wrong(line_, "is not four finite numbers 'x y z gray'");
    use(Row{{numbers[0], numbers[1], numbers[2]}, numbers[3], line_});
  }

  void comment(const char* from, const char* end) {
    const std::string_view words(from, static_cast<size_t>(end - from)), key = "# spacing_mm";
    if (!words.starts_with(key)) return;
    std::array<double, 3> numbers{};
    if (!parse_numbers(from + key.size(), end, numbers) ||
        !(*std::min_element(numbers.begin(), numbers.end()) > 0.0))
      throw wrong(line_, "'# spacing_mm' needs three positive numbers");
    spacing_mm = Vec3(numbers[0], numbers[1], numbers[2]);
  }

  fs::path path_;
  const Progress& progress_;
  std::ifstream in_;
  uint64_t size_ = 0, read_ = 0, line_ = 0;
};

/// The different positions along one axis, each with the first line that has it.
class Places {
 public:
  Places() : table_(4 * max_places) {}

  /// False when there are too many for a grid.
  bool add(double at, uint64_t line) {
    if (at == last_) return true;
    last_ = at;
    auto slot = (std::bit_cast<uint64_t>(at + 0.0) * 0x9e3779b97f4a7c15u) >> 49;
    while (table_[slot].line != 0) {
      if (table_[slot].at == at) return true;
      slot = (slot + 1) % table_.size();
    }
    if (++count_ > max_places) return false;
    table_[slot] = {at, line};
    return true;
  }

  struct Place {
    double at = 0.0;
    uint64_t line = 0;  // 0: no place
  };
  std::vector<Place> sorted() const {
    std::vector<Place> places;
    std::copy_if(table_.begin(), table_.end(), std::back_inserter(places),
                 [](const Place& p) { return p.line != 0; });
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.at < b.at; });
    return places;
  }

 private:
  std::vector<Place> table_;
  size_t count_ = 0;
  double last_ = std::nan("");
};

struct Axis {
  double first = 0.0, step = 1.0;
  int count = 0;
  bool indices = false;  // 0, 1, 2, ...
};

/// Positions that are one but for the way they are written are merged; what is left must be evenly spaced.
Axis axis_of(const Places& all, char name, const Rows& rows, const std::string& file) {
  auto places = all.sorted();
  const double length = places.back().at - places.front().at;
  const double same = same_place * length / static_cast<double>(places.size());
  const auto written_otherwise = [&](const auto& a, const auto& b) { return b.at - a.at <= same; };
  places.erase(std::unique(places.begin(), places.end(), written_otherwise), places.end());
  if (places.size() < 2)
    throw Error(ErrorKind::invalid_input,
                file + " has a single " + name + "; a volume has at least two voxels along each axis");
  std::vector<double> gaps;
  for (size_t i = 1; i < places.size(); ++i) gaps.push_back(places[i].at - places[i - 1].at);
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  const double usual = gaps[gaps.size() / 2];
  Axis axis;
  axis.first = places.front().at;
  axis.count = static_cast<int>(places.size());
  axis.step = (places.back().at - axis.first) / (axis.count - 1);
  const auto refuse = [&](const Places::Place& place) {
    return rows.wrong(place.line, std::string("its ") + name + " lies on no regular grid with the others");
  };
  for (size_t i = 1; i < places.size(); ++i)
    if (std::abs(places[i].at - places[i - 1].at - usual) > gap_tolerance * usual) throw refuse(places[i]);
  for (size_t i = 1; i < places.size(); ++i)
    if (std::abs(places[i].at - axis.first - static_cast<double>(i) * axis.step) > gap_tolerance * axis.step)
      throw refuse(places[i]);
  axis.indices = axis.first == 0.0 && axis.step == 1.0;
  return axis;
}

void set_place(HuVolume& volume, const std::array<Axis, 3>& axes, const std::optional<Vec3>& spacing_mm) {
  const bool indices = axes[0].indices && axes[1].indices && axes[2].indices;
  for (int k = 0; k < 3; ++k) {
    volume.dims[k] = axes[static_cast<size_t>(k)].count;
    volume.spacing_mm[k] = axes[static_cast<size_t>(k)].step;
    volume.world_from_volume.translation_mm[k] =
        axes[static_cast<size_t>(k)].first - 0.5 * volume.spacing_mm[k];
  }
  if (!indices) return;
  volume.spacing_mm = spacing_mm.value_or(Vec3::Ones());
  volume.world_from_volume.translation_mm = -0.5 * volume.spacing_mm;
  if (!spacing_mm)
    volume.warnings.push_back(
        "the rows give voxel indices without a size; voxels of 1 mm were taken (a line '# spacing_mm X Y Z' "
        "before the rows says otherwise)");
}

}  // namespace

HuVolume read_text_rows(const fs::path& path, const Progress& progress) {
  if (!fs::is_regular_file(path)) throw Error(ErrorKind::not_found, "no such file: " + path.string());
  const std::string file = path.string();
  const Progress first_half = part_of(progress, 0.0, 0.5), second_half = part_of(progress, 0.5, 1.0);
  std::array<Places, 3> places;
  uint64_t count = 0;
  Rows first(path, first_half);
  first.each([&](const Row& row) {
    ++count;
    for (size_t k = 0; k < 3; ++k)
      if (!places[k].add(row.at[k], row.line))
        throw first.wrong(row.line, std::string("more than 8192 different ") + "xyz"[k] +
                                        " so far; the rows are on no regular grid");
  });
  if (count == 0) throw Error(ErrorKind::invalid_input, file + " holds no rows 'x y z gray'");
  std::array<Axis, 3> axes;
  for (size_t k = 0; k < 3; ++k) axes[k] = axis_of(places[k], "xyz"[k], first, file);
  HuVolume volume;
  set_place(volume, axes, first.spacing_mm);
  if (static_cast<double>(volume.dims.x()) * volume.dims.y() * volume.dims.z() > max_ct_voxels)
    throw Error(ErrorKind::invalid_input, file + " spans a grid of more than 1e9 voxels");
  // Before memory is taken: a few far rows must not claim a large grid.
  if (count < volume.voxel_count() / 2)
    throw Error(ErrorKind::invalid_input, file + " has " + std::to_string(count) + " rows for a grid of " +
                                              std::to_string(volume.voxel_count()) +
                                              " voxels; every voxel needs one");
  volume.hu.assign(volume.voxel_count(), 0);
  std::vector<bool> seen(volume.voxel_count());
  Rows second(path, second_half);
  second.each([&](const Row& row) {
    Vec3i o;
    for (int k = 0; k < 3; ++k) {
      const Axis& axis = axes[static_cast<size_t>(k)];
      o[k] = static_cast<int>(std::floor((row.at[static_cast<size_t>(k)] - axis.first) / axis.step + 0.5));
    }
    if (!volume.contains(o)) throw second.wrong(row.line, "the file was changed while it was read");
    const size_t i = volume.index(o.x(), o.y(), o.z());
    if (seen[i]) throw second.wrong(row.line, "gives a voxel that an earlier line gave already");
    seen[i] = true;
    volume.hu[i] = static_cast<int16_t>(std::clamp(std::floor(row.gray + 0.5), -32768.0, 32767.0));
  });
  const auto hole = static_cast<size_t>(std::find(seen.begin(), seen.end(), false) - seen.begin());
  if (hole < seen.size()) {
    const auto nx = static_cast<size_t>(volume.dims.x()), ny = static_cast<size_t>(volume.dims.y());
    throw Error(ErrorKind::invalid_input, file + ": no row gives voxel " + std::to_string(hole % nx) + " " +
                                              std::to_string(hole / nx % ny) + " " +
                                              std::to_string(hole / nx / ny) + " of the grid");
  }
  volume.source = path.filename().string();
  return volume;
}

}  // namespace ream::reader
