#include "ct/itk_volume.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace ream::ct {
namespace {

constexpr double axis_tolerance = 1e-3;

/// Numbers that no scanner gives: not finite, huge, or so small that only swapped bytes make them.
bool absurd(double v) {
  const double size = std::abs(v);
  return !(size < 1e9) || (size > 0.0 && size < 1e-30);
}

template <typename T>
std::vector<int16_t> clamped(const std::vector<char>& bytes, size_t count, const std::string& place) {
  const T* values = reinterpret_cast<const T*>(bytes.data());
  std::vector<int16_t> result(count);
  if constexpr (std::is_floating_point_v<T>) {
    const auto wrong =
        std::count_if(values, values + count, [](T v) { return absurd(static_cast<double>(v)); });
    if (static_cast<size_t>(wrong) > count / 20)
      throw Error(ErrorKind::invalid_input, place + ": " + std::to_string(wrong) +
                                                " voxels are no sensible numbers; its bytes may be swapped");
  }
  for (size_t i = 0; i < count; ++i) {
    const double v = std::floor(static_cast<double>(values[i]) + 0.5);
    // NaN fails both comparisons and becomes air.
    result[i] = v >= 32767.0 ? int16_t{32767} : v > -32768.0 ? static_cast<int16_t>(v) : int16_t{-32768};
  }
  return result;
}

std::vector<int16_t> converted(itk::IOComponentEnum type, const std::vector<char>& bytes, size_t count,
                               const std::string& place) {
  switch (type) {
    case itk::IOComponentEnum::UCHAR:
      return clamped<unsigned char>(bytes, count, place);
    case itk::IOComponentEnum::CHAR:
      return clamped<signed char>(bytes, count, place);
    case itk::IOComponentEnum::USHORT:
      return clamped<unsigned short>(bytes, count, place);
    case itk::IOComponentEnum::UINT:
      return clamped<unsigned int>(bytes, count, place);
    case itk::IOComponentEnum::INT:
      return clamped<int>(bytes, count, place);
    case itk::IOComponentEnum::ULONG:
      return clamped<unsigned long>(bytes, count, place);
    case itk::IOComponentEnum::LONG:
      return clamped<long>(bytes, count, place);
    case itk::IOComponentEnum::ULONGLONG:
      return clamped<unsigned long long>(bytes, count, place);
    case itk::IOComponentEnum::LONGLONG:
      return clamped<long long>(bytes, count, place);
    case itk::IOComponentEnum::FLOAT:
      return clamped<float>(bytes, count, place);
    case itk::IOComponentEnum::DOUBLE:
      return clamped<double>(bytes, count, place);
    default:
      return {};
  }
}

void reverse_last_axis(HuVolume& volume) {
  const auto slice = static_cast<std::ptrdiff_t>(volume.dims.x()) * volume.dims.y();
  auto begin = volume.hu.begin();
  for (int low = 0, high = volume.dims.z() - 1; low < high; ++low, --high)
    std::swap_ranges(begin + low * slice, begin + (low + 1) * slice, begin + high * slice);
}

}  // namespace

ItkGeometry geometry_of(const itk::ImageIOBase& io) {
  ItkGeometry g;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const bool has = axis < io.GetNumberOfDimensions();
    g.dims[axis] = has ? static_cast<int>(io.GetDimensions(axis)) : 1;
    g.spacing_mm[axis] = has ? io.GetSpacing(axis) : 1.0;
    g.origin_mm[axis] = has ? io.GetOrigin(axis) : 0.0;
    if (!has) continue;
    const std::vector<double> column = io.GetDirection(axis);
    for (unsigned row = 0; row < 3; ++row) g.direction(row, axis) = row < column.size() ? column[row] : 0.0;
  }
  return g;
}

std::vector<int16_t> read_values(itk::ImageIOBase& io, const std::string& place) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  itk::ImageIORegion region(dimensions);
  size_t count = 1;
  for (unsigned axis = 0; axis < dimensions; ++axis) {
    region.SetSize(axis, io.GetDimensions(axis));
    count *= io.GetDimensions(axis);
  }
  if (io.GetNumberOfComponents() != 1)
    throw Error(ErrorKind::invalid_input, place + " has more than one value per voxel; a CT has one");
  io.SetIORegion(region);
  if (io.GetComponentType() == itk::IOComponentEnum::SHORT) {
    std::vector<int16_t> values(count);
    io.Read(values.data());
    return values;
  }
  std::vector<char> bytes(static_cast<size_t>(io.GetImageSizeInBytes()));
  io.Read(bytes.data());
  auto values = converted(io.GetComponentType(), bytes, count, place);
  if (values.size() != count)
    throw Error(ErrorKind::invalid_input, place + " holds voxels of an unknown type");
  return values;
}

void set_geometry(HuVolume& volume, const ItkGeometry& geometry, const std::string& place) {
  const Mat3& d = geometry.direction;
  if (!d.allFinite() || !((d.transpose() * d - Mat3::Identity()).cwiseAbs().maxCoeff() < axis_tolerance))
    throw Error(ErrorKind::invalid_input,
                place + ": the voxel axes are not perpendicular; resample the volume first");
  if (!geometry.spacing_mm.allFinite() || !(geometry.spacing_mm.minCoeff() > 0.0) ||
      !geometry.origin_mm.allFinite())
    throw Error(ErrorKind::invalid_input,
                place + ": voxel size and position must be finite, the size positive");
  volume.dims = geometry.dims;
  volume.spacing_mm = geometry.spacing_mm;
  Mat3 rotation = d;
  Vec3 origin = geometry.origin_mm;
  if (d.determinant() < 0.0) {
    origin += d.col(2) * (geometry.spacing_mm.z() * (geometry.dims.z() - 1));
    rotation.col(2) = -d.col(2);
    reverse_last_axis(volume);
  }
  const bool exact = (rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-12;
  volume.world_from_volume.rotation = exact ? rotation : orthonormalized(rotation);
  volume.world_from_volume.translation_mm =
      origin - volume.world_from_volume.direction(0.5 * volume.spacing_mm);
}

void describe(itk::ImageIOBase& io, const HuVolume& volume) {
  const Vec3 origin = volume.world_of_centre(Vec3i::Zero());
  itk::ImageIORegion region(3);
  io.SetNumberOfDimensions(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    io.SetDimensions(axis, static_cast<unsigned>(volume.dims[axis]));
    io.SetSpacing(axis, volume.spacing_mm[axis]);
    io.SetOrigin(axis, origin[axis]);
    const Vec3 column = volume.world_from_volume.rotation.col(axis);
    io.SetDirection(axis, std::vector<double>{column.x(), column.y(), column.z()});
    region.SetSize(axis, static_cast<unsigned long>(volume.dims[axis]));
  }
  io.SetIORegion(region);
  io.SetPixelType(itk::IOPixelEnum::SCALAR);
  io.SetComponentType(itk::IOComponentEnum::SHORT);
  io.SetNumberOfComponents(1);
}

std::string short_reason(const itk::ExceptionObject& e) {
  std::string text = e.GetDescription();
  const auto colon = text.find("): ");
  if (colon != std::string::npos) text = text.substr(colon + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace ream::ct
