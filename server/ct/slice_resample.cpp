#include "ct/slice_resample.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "ct/volume_io.hpp"

namespace ream::ct {
namespace {

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

void load_stack(HuVolume& volume, const SliceStack& stack, const std::string& place,
                const Progress& progress) {
  const Plane plane = plane_of(stack, place);
  place_volume(volume, stack, plane);
  if (static_cast<double>(plane.columns) * plane.rows * stack.count > max_ct_voxels)
    throw Error(ErrorKind::invalid_input, place + " makes more than 1e9 voxels; give a smaller series");
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

}  // namespace ream::ct
