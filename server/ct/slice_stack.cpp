#include "ct/slice_stack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"

namespace ream::ct {
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

std::string rounded(double v, const char* format = "%.4g") {
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
    throw Error(ErrorKind::invalid_input,
                place + ": slices are missing between " + rounded(slices[gap_at - 1].position_mm, "%.0f") +
                    " and " + rounded(slices[gap_at].position_mm, "%.0f") + " mm; give a complete series");
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
      gaps = " (first between " + rounded(slices[i - 1].position_mm, "%.0f") + " and " +
             rounded(slices[i].position_mm, "%.0f") + " mm)";
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
    stack.warnings.push_back("the slices are " + rounded(narrowest) + " to " + rounded(widest) +
                             " mm apart; they were resampled linearly to the median distance of " +
                             rounded(median) + " mm");
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
  stack.warnings.push_back("the slices are shifted against each other by up to " + rounded(largest, "%.1f") +
                           " mm (gantry tilted by " + rounded(tilt_deg, "%.1f") +
                           " degrees); they were resampled on an orthogonal grid");
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

}  // namespace ream::ct
