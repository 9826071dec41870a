#include "ct/segment/bone_filters.hpp"

#include <itkBlackTopHatImageFilter.h>
#include <itkFlatStructuringElement.h>
#include <itkImportImageFilter.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <limits>
#include <mutex>

#include "core/error.hpp"
#include "ct/segment/voxel_window.hpp"

namespace ream::ct {
namespace {

using MaskImage = itk::Image<uint8_t, 3>;
using HuImage = itk::Image<int16_t, 3>;
using DistanceImage = itk::Image<float, 3>;

/// For filters that are made from here on. ITK's pool of threads loses what one of them throws: when memory
/// ran out, a part of the result was missing, and nobody heard of it. Threads of the platform are made anew,
/// and tell.
void choose_threads() {
  static std::once_flag chosen;
  std::call_once(chosen, [] {
    itk::MultiThreaderBase::SetGlobalDefaultThreader(itk::MultiThreaderBase::ThreaderEnum::Platform);
  });
}

template <typename Filter>
void run(Filter& filter) {
  try {
    filter.Update();
  } catch (const itk::ExceptionObject&) {  // nothing else goes wrong with images of ours
    throw Error(ErrorKind::unavailable, "not enough memory to filter the CT; use a smaller region");
  }
}

/// An image over the caller's memory.
template <typename T>
typename itk::Image<T, 3>::Pointer image_over(const std::vector<T>& values, const Vec3i& dims,
                                              const Vec3& spacing_mm) {
  auto import = itk::ImportImageFilter<T, 3>::New();
  itk::ImageRegion<3> region;
  double spacing[3];
  for (unsigned axis = 0; axis < 3; ++axis) {
    region.SetSize(axis, static_cast<itk::SizeValueType>(dims[axis]));
    spacing[axis] = spacing_mm[axis];
  }
  import->SetRegion(region);
  import->SetSpacing(spacing);
  import->SetImportPointer(const_cast<T*>(values.data()), values.size(), false);
  import->Update();
  return import->GetOutput();
}

Mask inverted(const Mask& mask) {
  Mask result(mask.size());
  std::transform(mask.begin(), mask.end(), result.begin(), [](uint8_t m) { return uint8_t{m == 0}; });
  return result;
}

}  // namespace

std::vector<float> distance_to_set_mm(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm) {
  if (count_set(mask) == 0) return std::vector<float>(mask.size(), std::numeric_limits<float>::infinity());
  choose_threads();
  auto maurer = itk::SignedMaurerDistanceMapImageFilter<MaskImage, DistanceImage>::New();
  maurer->SetInput(image_over(mask, dims, spacing_mm));
  maurer->SetBackgroundValue(0);
  maurer->SetSquaredDistance(false);
  maurer->SetUseImageSpacing(true);
  maurer->SetInsideIsPositive(false);
  run(*maurer);
  const float* first = maurer->GetOutput()->GetBufferPointer();
  std::vector<float> distance(first, first + mask.size());
  for (float& d : distance) d = std::max(d, 0.0F);
  return distance;
}

Mask closed_by_ball(const Mask& mask, const Vec3i& dims, const Vec3& spacing_mm, double radius_mm) {
  const Vec3i border = (radius_mm / spacing_mm.array()).ceil().cast<int>().matrix() + Vec3i::Ones();
  const VoxelWindow all{Vec3i::Zero(), dims}, wide{-border, dims + 2 * border};
  const auto reach = static_cast<float>(radius_mm);
  Mask dilated(static_cast<size_t>(wide.dims.x()) * static_cast<size_t>(wide.dims.y()) *
               static_cast<size_t>(wide.dims.z()));
  copy_common(mask, all, dilated, wide);
  std::vector<float> distance = distance_to_set_mm(dilated, wide.dims, spacing_mm);
  for (size_t i = 0; i < dilated.size(); ++i) dilated[i] = distance[i] <= reach;
  distance = distance_to_set_mm(inverted(dilated), wide.dims, spacing_mm);
  for (size_t i = 0; i < dilated.size(); ++i) dilated[i] = distance[i] > reach;
  Mask closed(mask.size());
  copy_common(dilated, wide, closed, all);
  for (size_t i = 0; i < mask.size(); ++i) closed[i] = closed[i] || mask[i];
  return closed;
}

std::vector<int16_t> valley_depth_hu(const std::vector<int16_t>& hu, const Vec3i& dims,
                                     const Vec3& spacing_mm, double radius_mm) {
  using Ball = itk::FlatStructuringElement<3>;
  Ball::RadiusType radius;
  for (unsigned axis = 0; axis < 3; ++axis)
    radius[axis] =
        static_cast<itk::SizeValueType>(std::max(1.0, std::floor(radius_mm / spacing_mm[axis] + 0.5)));
  choose_threads();
  auto top_hat = itk::BlackTopHatImageFilter<HuImage, HuImage, Ball>::New();
  top_hat->SetInput(image_over(hu, dims, spacing_mm));
  top_hat->SetKernel(Ball::Ball(radius));
  top_hat->SetSafeBorder(true);
  run(*top_hat);
  const int16_t* first = top_hat->GetOutput()->GetBufferPointer();
  return {first, first + hu.size()};
}

}  // namespace ream::ct
