#include "reader/slice_stack.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "reader/ct_files.hpp"

namespace ream::reader {
namespace {

constexpr double same_orientation = 1e-3;
constexpr size_t max_groups = 64;  // further ones cannot be the largest in a usable series
constexpr double duplicate_mm = 0.01;
constexpr double max_gap_slices = 4.0;    // a wider gap is two scans, not a lost slice
constexpr double stray_share = 0.2;       // at most this share of a series may lie apart from the rest
constexpr double on_grid_share = 0.05;    // of the distance; rounded positions stay below it
constexpr double max_shift_pixels = 0.1;  // below it, a shift is rounding of the positions

bool fits(const DicomSlice& a, const DicomSlice& b) {
  return a.columns == b.columns && a.rows == b.rows &&
         (a.along_row - b.along_row).cwiseAbs().maxCoeff() < same_orientation &&
         (a.along_column - b.along_column).cwiseAbs().maxCoeff() < same_orientation &&
         (a.spacing_mm - b.spacing_mm).head<2>().cwiseAbs().maxCoeff() < same_orientation * a.spacing_mm.x();
}

std::string rounded_text(double v, const char* format = "%.4g") {
  char text[32];
  std::snprintf(text, sizeof text, format, v + 0.0);
  return text;
}

/// The slices that share the orientation and size of most.
std::vector<DicomSlice> majority(const std::vector<DicomSlice>& all, SliceStack& stack) {
  std::vector<std::vector<size_t>> groups;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& g) { return fits(all[g.front()], all[i]); });
    if (group != groups.end())
      group->push_back(i);
    else if (groups.size() < max_groups)
      groups.push_back({i});
  }
  const auto largest = std::max_element(groups.begin(), groups.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<DicomSlice> kept;
  for (const size_t i : *largest) kept.push_back(all[i]);
  if (kept.size() < all.size())
    stack.warnings.push_back(std::to_string(all.size() - kept.size()) +
                             " slices of another orientation or size were left out");
  return kept;
}

/// Sorts along the normal and leaves out what lies where another slice does: of those the lowest number
/// stays, so that a scan made twice is not mixed.
void sort_and_thin(std::vector<DicomSlice>& slices, SliceStack& stack) {
  const Vec3 normal = slices.front().normal();
  for (DicomSlice& s : slices) s.position_mm = s.origin_mm.dot(normal);
  std::stable_sort(slices.begin(), slices.end(), [](const DicomSlice& a, const DicomSlice& b) {
    return std::pair(a.position_mm, a.number) < std::pair(b.position_mm, b.number);
  });
  std::vector<DicomSlice> kept;
  for (DicomSlice& s : slices) {
    if (kept.empty() || s.position_mm - kept.back().position_mm >= duplicate_mm)
      kept.push_back(std::move(s));
    else if (s.number < kept.back().number)
      kept.back() = std::move(s);
  }
  if (kept.size() < slices.size())
    stack.warnings.push_back(std::to_string(slices.size() - kept.size()) +
                             " slices at the place of another one were left out");
  slices = std::move(kept);
}

double median_distance_mm(const std::vector<DicomSlice>& slices) {
  std::vector<double> gaps;
  for (size_t i = 1; i < slices.size(); ++i)
    gaps.push_back(slices[i].position_mm - slices[i - 1].position_mm);
  std::nth_element(gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2), gaps.end());
  return gaps[gaps.size() / 2];
}

/// Leaves out the few slices that lie far from the rest; refuses when they are not few.
void drop_strays(std::vector<DicomSlice>& slices, SliceStack& stack, const std::string& place) {
  const double widest = max_gap_slices * median_distance_mm(slices);
  size_t best = 0, best_end = 0, begin = 0, gap_at = 0;
  for (size_t i = 1; i <= slices.size(); ++i) {
    const bool gap = i == slices.size() || slices[i].position_mm - slices[i - 1].position_mm > widest;
    if (!gap) continue;
    if (i < slices.size()) gap_at = i;
    if (i - begin > best_end - best) best = begin, best_end = i;
    begin = i;
  }
  const size_t strays = slices.size() - (best_end - best);
  if (strays == 0) return;
  if (static_cast<double>(strays) > stray_share * static_cast<double>(slices.size()) || best_end - best < 2)
    throw Error(ErrorKind::invalid_input, place + ": slices are missing between " +
                                              rounded_text(slices[gap_at - 1].position_mm, "%.0f") + " and " +
                                              rounded_text(slices[gap_at].position_mm, "%.0f") +
                                              " mm; give a complete series");
  slices = {slices.begin() + static_cast<std::ptrdiff_t>(best),
            slices.begin() + static_cast<std::ptrdiff_t>(best_end)};
  stack.warnings.push_back(std::to_string(strays) + " stray slices far from the others were left out");
}

/// The even grid: when all gaps are whole multiples of one distance, that distance, fitted over the whole
/// stack so that rounded positions do not add up; else the median distance.
void choose_grid(SliceStack& stack) {
  const auto& slices = stack.slices;
  const double median = median_distance_mm(slices),
               length = slices.back().position_mm - slices[0].position_mm;
  std::vector<double> places{0.0};
  std::string gaps;
  int missing = 0;
  double narrowest = median, widest = median;
  for (size_t i = 1; i < slices.size(); ++i) {
    const double gap = slices[i].position_mm - slices[i - 1].position_mm;
    const double steps = std::floor(gap / median + 0.5);
    places.push_back(places.back() + steps);
    missing += std::max(0, static_cast<int>(steps) - 1);
    narrowest = std::min(narrowest, gap);
    widest = std::max(widest, gap);
    if (steps > 1.0 && gaps.empty())
      gaps = " (first between " + rounded_text(slices[i - 1].position_mm, "%.0f") + " and " +
             rounded_text(slices[i].position_mm, "%.0f") + " mm)";
  }
  const double fitted = places.back() > 0.0 ? length / places.back() : 0.0;
  stack.even = fitted > 0.0;
  for (size_t i = 0; i < slices.size(); ++i)
    stack.even = stack.even && std::abs(slices[i].position_mm - slices[0].position_mm - places[i] * fitted) <=
                                   on_grid_share * fitted;
  stack.distance_mm = stack.even ? fitted : median;
  stack.count = static_cast<int>(std::floor(length / stack.distance_mm + (stack.even ? 0.5 : 1e-6))) + 1;
  if (stack.even && missing > 0)
    stack.warnings.push_back(std::to_string(missing) + " missing slices were interpolated" + gaps);
  if (!stack.even)
    stack.warnings.push_back("the slices are " + rounded_text(narrowest) + " to " + rounded_text(widest) +
                             " mm apart; they were resampled linearly to the median distance of " +
                             rounded_text(median) + " mm");
}

void measure_shear(SliceStack& stack) {
  const DicomSlice& first = stack.slices.front();
  double largest = 0.0;
  for (const DicomSlice& s : stack.slices) {
    const Vec3 way = s.origin_mm - first.origin_mm;
    largest = std::max({largest, std::abs(way.dot(first.along_row)), std::abs(way.dot(first.along_column))});
  }
  stack.sheared = largest > max_shift_pixels * first.spacing_mm.head<2>().minCoeff();
  if (!stack.sheared) return;
  const Vec3 way = stack.slices.back().origin_mm - first.origin_mm;
  const double along = way.dot(first.normal());
  const double tilt_deg = std::atan2((way - along * first.normal()).norm(), along) * 180.0 / 3.14159265358979;
  stack.warnings.push_back("the slices are shifted against each other by up to " +
                           rounded_text(largest, "%.1f") + " mm (gantry tilted by " +
                           rounded_text(tilt_deg, "%.1f") +
                           " degrees); they were resampled on an orthogonal grid");
}

using Vec2 = Eigen::Vector2d;
using Values = std::vector<int16_t>;

/// Where in the first slice's pixels a slice's first pixel lies.
Vec2 shift_pixels(const DicomSlice& first, const DicomSlice& slice) {
  const Vec3 way = slice.origin_mm - first.origin_mm;
  return {way.dot(first.along_row) / first.spacing_mm.x(),
          way.dot(first.along_column) / first.spacing_mm.y()};
}

/// The pixels of the grid's plane that all slices together cover.
struct Plane {
  int u0 = 0, v0 = 0, columns = 0, rows = 0;  // the first pixel in pixels of the first slice
};

Plane plane_of(const SliceStack& stack, const std::string& place) {
  const DicomSlice& first = stack.slices.front();
  if (!stack.sheared) return {0, 0, first.columns, first.rows};
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  for (const DicomSlice& s : stack.slices) {
    low = low.cwiseMin(shift_pixels(first, s));
    high = high.cwiseMax(shift_pixels(first, s));
  }
  constexpr double slack = 1e-3;  // a shift by whole pixels takes no further one
  if ((high - low).maxCoeff() > 4.0 * std::max(first.columns, first.rows))
    throw Error(ErrorKind::invalid_input, place + ": the slices do not lie over each other; give one series");
  const auto low_u = static_cast<int>(std::floor(low.x() + slack)),
             low_v = static_cast<int>(std::floor(low.y() + slack));
  return {low_u, low_v, first.columns + static_cast<int>(std::ceil(high.x() - slack)) - low_u,
          first.rows + static_cast<int>(std::ceil(high.y() - slack)) - low_v};
}

int16_t rounded(double v) { return static_cast<int16_t>(std::floor(v + 0.5)); }

Values shifted(const Values& from, const DicomSlice& slice, const Vec2& shift, const Plane& plane) {
  Values to(static_cast<size_t>(plane.columns) * static_cast<size_t>(plane.rows), min_hu);
  const auto value = [&](int u, int v) -> double {
    if (u < 0 || v < 0 || u >= slice.columns || v >= slice.rows) return min_hu;
    return from[static_cast<size_t>(v) * static_cast<size_t>(slice.columns) + static_cast<size_t>(u)];
  };
  for (int v = 0; v < plane.rows; ++v)
    for (int u = 0; u < plane.columns; ++u) {
      const double x = u + plane.u0 - shift.x(), y = v + plane.v0 - shift.y();
      const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
      if (i < -1 || j < -1 || i >= slice.columns || j >= slice.rows) continue;
      const double a = x - i, b = y - j;
      const double mixed = (1 - b) * ((1 - a) * value(i, j) + a * value(i + 1, j)) +
                           b * ((1 - a) * value(i, j + 1) + a * value(i + 1, j + 1));
      to[static_cast<size_t>(v) * static_cast<size_t>(plane.columns) + static_cast<size_t>(u)] =
          rounded(mixed);
    }
  return to;
}

void append_mixed(Values& hu, const Values& below, const Values& above, double share) {
  if (share <= 0.0 || share >= 1.0) {
    const Values& same = share <= 0.0 ? below : above;
    hu.insert(hu.end(), same.begin(), same.end());
    return;
  }
  for (size_t i = 0; i < below.size(); ++i) hu.push_back(rounded(below[i] + (above[i] - below[i]) * share));
}

void place_volume(HuVolume& volume, const SliceStack& stack, const Plane& plane) {
  const DicomSlice& first = stack.slices.front();
  volume.dims = {plane.columns, plane.rows, stack.count};
  volume.spacing_mm = {first.spacing_mm.x(), first.spacing_mm.y(), stack.distance_mm};
  Mat3 axes;
  axes << first.along_row, first.along_column, first.normal();
  const bool exact = (axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-12;
  volume.world_from_volume.rotation = exact ? axes : orthonormalized(axes);
  const Vec3 corner{(plane.u0 - 0.5) * first.spacing_mm.x(), (plane.v0 - 0.5) * first.spacing_mm.y(),
                    -0.5 * stack.distance_mm};
  volume.world_from_volume.translation_mm = first.origin_mm + volume.world_from_volume.direction(corner);
}

}  // namespace

SliceStack stack_of(const std::vector<DicomSlice>& series, const std::string& place) {
  SliceStack stack;
  auto slices = majority(series, stack);
  sort_and_thin(slices, stack);
  if (slices.size() >= 2) drop_strays(slices, stack, place);
  if (slices.size() < 2)
    throw Error(ErrorKind::invalid_input, place + " holds a single CT slice; a volume needs at least two");
  stack.slices = std::move(slices);
  choose_grid(stack);
  measure_shear(stack);
  return stack;
}

void load_stack(HuVolume& volume, const SliceStack& stack, const std::string& place, uint64_t max_bytes,
                const Progress& progress) {
  const Plane plane = plane_of(stack, place);
  place_volume(volume, stack, plane);
  if (static_cast<double>(plane.columns) * plane.rows * stack.count > max_ct_voxels)
    throw Error(ErrorKind::invalid_input, place + " makes more than 1e9 voxels; give a smaller series");
  check_bytes(volume, max_bytes, place);
  const auto& slices = stack.slices;
  DicomPixels pixels;
  const auto read = [&](size_t i) {
    progress(static_cast<double>(i) / static_cast<double>(slices.size()), "reading slices");
    Values values = pixels.hu(slices[i]);
    if (stack.sheared) values = shifted(values, slices[i], shift_pixels(slices[0], slices[i]), plane);
    return values;
  };
  volume.hu.reserve(volume.voxel_count());
  // On an even stack slices lie on the grid but for rounding, which must not mix them.
  const double on_grid = stack.even ? 0.1 : 1e-6;
  Values below = read(0), above = read(1);
  size_t next = 1;
  for (int w = 0; w < stack.count; ++w) {
    const double at = slices[0].position_mm + w * stack.distance_mm;
    while (next + 1 < slices.size() && at > slices[next].position_mm + on_grid * stack.distance_mm) {
      below = std::move(above);
      above = read(++next);
    }
    const double from = slices[next - 1].position_mm, to = slices[next].position_mm;
    double share = (at - from) / (to - from);
    if (std::abs(at - from) <= on_grid * stack.distance_mm) share = 0.0;
    if (std::abs(at - to) <= on_grid * stack.distance_mm) share = 1.0;
    append_mixed(volume.hu, below, above, share);
  }
  if (pixels.outside() > 0)
    volume.warnings.push_back(std::to_string(pixels.outside()) +
                              " voxels below -1024 HU or marked as padding (outside the scanner's field of "
                              "view) were taken as air");
  progress(1.0, "reading slices");
}

}  // namespace ream::reader
