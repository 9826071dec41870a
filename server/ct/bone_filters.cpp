#include "ct/bone_filters.hpp"

#include <itkImportImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <limits>

namespace ream::ct {
namespace {

using MaskImage = itk::Image<uint8_t, 3>;
using DistanceImage = itk::Image<float, 3>;

/// An image over the caller's memory.
MaskImage::Pointer image_over(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm) {
  auto import = itk::ImportImageFilter<uint8_t, 3>::New();
  itk::ImageRegion<3> region;
  double spacing[3];
  for (unsigned axis = 0; axis < 3; ++axis) {
    region.SetSize(axis, static_cast<itk::SizeValueType>(dims[axis]));
    spacing[axis] = spacing_mm[axis];
  }
  import->SetRegion(region);
  import->SetSpacing(spacing);
  import->SetImportPointer(const_cast<uint8_t*>(mask.data()), mask.size(), false);
  import->Update();
  return import->GetOutput();
}

Mask inverted(const Mask& mask) {
  Mask result(mask.size());
  std::transform(mask.begin(), mask.end(), result.begin(), [](uint8_t m) { return uint8_t{m == 0}; });
  return result;
}

/// With `border` empty voxels on every side.
Mask widened(const Mask& mask, const Vec3i& dims, const Vec3i& border, const Vec3i& wide) {
  Mask result(static_cast<size_t>(wide.x()) * static_cast<size_t>(wide.y()) * static_cast<size_t>(wide.z()));
  const auto nx = static_cast<size_t>(dims.x()), ny = static_cast<size_t>(dims.y());
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v) {
      const size_t from = nx * (static_cast<size_t>(v) + ny * static_cast<size_t>(w));
      const size_t to = static_cast<size_t>(border.x()) +
                        static_cast<size_t>(wide.x()) *
                            (static_cast<size_t>(v + border.y()) +
                             static_cast<size_t>(wide.y()) * static_cast<size_t>(w + border.z()));
      std::copy_n(mask.begin() + static_cast<std::ptrdiff_t>(from), nx,
                  result.begin() + static_cast<std::ptrdiff_t>(to));
    }
  return result;
}

}  // namespace

std::vector<float> distance_to_set_mm(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm) {
  if (count_set(mask) == 0) return std::vector<float>(mask.size(), std::numeric_limits<float>::infinity());
  auto maurer = itk::SignedMaurerDistanceMapImageFilter<MaskImage, DistanceImage>::New();
  maurer->SetInput(image_over(mask, dims, spacing_mm));
  maurer->SetBackgroundValue(0);
  maurer->SetSquaredDistance(false);
  maurer->SetUseImageSpacing(true);
  maurer->SetInsideIsPositive(false);
  maurer->Update();
  const float* first = maurer->GetOutput()->GetBufferPointer();
  std::vector<float> distance(first, first + mask.size());
  for (float& d : distance) d = std::max(d, 0.0F);
  return distance;
}

Mask closed_by_ball(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm, double radius_mm) {
  const Vec3i border = (radius_mm / spacing_mm.array()).ceil().cast<int>().matrix() + Vec3i::Ones();
  const Vec3i wide = dims + 2 * border;
  const auto reach = static_cast<float>(radius_mm);
  Mask dilated = widened(mask, dims, border, wide);
  std::vector<float> distance = distance_to_set_mm(dilated, wide, spacing_mm);
  for (size_t i = 0; i < dilated.size(); ++i) dilated[i] = distance[i] <= reach;
  distance = distance_to_set_mm(inverted(dilated), wide, spacing_mm);
  Mask closed = mask;
  size_t here = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u, ++here) {
        const size_t in_wide = static_cast<size_t>(u + border.x()) +
                               static_cast<size_t>(wide.x()) *
                                   (static_cast<size_t>(v + border.y()) +
                                    static_cast<size_t>(wide.y()) * static_cast<size_t>(w + border.z()));
        if (distance[in_wide] > reach) closed[here] = 1;
      }
  return closed;
}

}  // namespace ream::ct
