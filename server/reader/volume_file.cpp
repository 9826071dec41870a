#include "reader/volume_file.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "reader/ct_files.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr double axis_tolerance = 1e-3;

/// Where an image file says its voxels are: ITK's convention, LPS, origin at the centre of the first voxel.
struct ItkGeometry {
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones(), origin_mm = Vec3::Zero();
  Mat3 direction = Mat3::Identity();  ///< columns are the voxel axes
};

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

/// Refuses what has no three dimensions, no voxels or more than max_ct_voxels.
void check_dimensions(const itk::ImageIOBase& io, const std::string& name) {
  double voxels = 1.0;
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    voxels *= static_cast<double>(io.GetDimensions(axis));
    if (axis >= 3 && io.GetDimensions(axis) != 1)
      throw Error(ErrorKind::invalid_input, name + " has more than three dimensions; a CT has three");
  }
  if (io.GetNumberOfDimensions() < 3)
    throw Error(ErrorKind::invalid_input, name + " is a flat image; a CT has three dimensions");
  if (!(voxels >= 1.0)) throw Error(ErrorKind::invalid_input, name + " has a side of zero voxels");
  if (voxels > max_ct_voxels) throw Error(ErrorKind::invalid_input, name + " has more than 1e9 voxels");
}

Error unreadable(const std::string& name, const itk::ExceptionObject& e) {
  return {ErrorKind::invalid_input, name + " cannot be read, it may be cut short: " + ct::short_reason(e)};
}

/// Numbers that no scanner gives: not finite, huge, or so small that only swapped bytes make them.
bool absurd(double v) {
  const double size = std::abs(v);
  return !(size < 1e9) || (size > 0.0 && size < 1e-30);
}

template <typename T>
std::vector<int16_t> clamped(const T* values, size_t count, const std::string& name) {
  std::vector<int16_t> result(count);
  if constexpr (std::is_floating_point_v<T>) {
    const auto wrong =
        std::count_if(values, values + count, [](T v) { return absurd(static_cast<double>(v)); });
    if (static_cast<size_t>(wrong) > count / 20)
      throw Error(ErrorKind::invalid_input, name + ": " + std::to_string(wrong) +
                                                " voxels are no sensible numbers; its bytes may be swapped");
  }
  for (size_t i = 0; i < count; ++i) {
    const double v = std::floor(static_cast<double>(values[i]) + 0.5);
    // NaN fails both comparisons and becomes air.
    result[i] = v >= 32767.0 ? int16_t{32767} : v > -32768.0 ? static_cast<int16_t>(v) : int16_t{-32768};
  }
  return result;
}

/// All values, clamped to 16 bits.
std::vector<int16_t> read_values(VolumeFile& file) {
  if (file.values_per_voxel() != 1)
    throw Error(ErrorKind::invalid_input, file.name() + " has more than one value per voxel; a CT has one");
  const size_t count = file.image_bytes() / file.value_bytes();
  std::vector<int16_t> values;
  if (file.type() == itk::IOComponentEnum::SHORT) {
    values.resize(count);
    file.read(values.data());
    return values;
  }
  std::vector<char> bytes(file.image_bytes());
  file.read(bytes.data());
  with_values(file.type(), bytes.data(), file.name(),
              [&](const auto* all) { values = clamped(all, count, file.name()); });
  return values;
}

void reverse_last_axis(HuVolume& volume) {
  const auto slice = static_cast<std::ptrdiff_t>(volume.dims.x()) * volume.dims.y();
  auto begin = volume.hu.begin();
  for (int low = 0, high = volume.dims.z() - 1; low < high; ++low, --high)
    std::swap_ranges(begin + low * slice, begin + (low + 1) * slice, begin + high * slice);
}

}  // namespace

VolumeFile::VolumeFile(const fs::path& path)
    : name_(path.string()), io_(ct::image_io_for(path)), header_(path) {
  itk::Object::GlobalWarningDisplayOff();
  try {
    io_->SetFileName(header_.readable_path().string());
    io_->ReadImageInformation();
    check_dimensions(*io_, name_);
    header_.check_complete(image_bytes());
  } catch (const itk::ExceptionObject& e) {
    throw unreadable(name_, e);
  }
}

void VolumeFile::read(void* to) {
  itk::ImageIORegion region(io_->GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io_->GetNumberOfDimensions(); ++axis)
    region.SetSize(axis, io_->GetDimensions(axis));
  io_->SetIORegion(region);
  try {
    io_->Read(to);
  } catch (const itk::ExceptionObject& e) {
    throw unreadable(name_, e);
  }
}

bool VolumeFile::place(HuVolume& volume) const {
  const ItkGeometry geometry = geometry_of(*io_);
  const Mat3& d = geometry.direction;
  if (!d.allFinite() || !((d.transpose() * d - Mat3::Identity()).cwiseAbs().maxCoeff() < axis_tolerance))
    throw Error(ErrorKind::invalid_input,
                name_ + ": the voxel axes are not perpendicular; resample the volume first");
  if (!geometry.spacing_mm.allFinite() || !(geometry.spacing_mm.minCoeff() > 0.0) ||
      !geometry.origin_mm.allFinite())
    throw Error(ErrorKind::invalid_input,
                name_ + ": voxel size and position must be finite, the size positive");
  volume.dims = geometry.dims;
  volume.spacing_mm = geometry.spacing_mm;
  const bool left_handed = d.determinant() < 0.0;
  Mat3 rotation = d;
  Vec3 origin = geometry.origin_mm;
  if (left_handed) {
    origin += d.col(2) * (geometry.spacing_mm.z() * (geometry.dims.z() - 1));
    rotation.col(2) = -d.col(2);
  }
  const bool exact = (rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-12;
  volume.world_from_volume.rotation = exact ? rotation : orthonormalized(rotation);
  volume.world_from_volume.translation_mm =
      origin - volume.world_from_volume.direction(0.5 * volume.spacing_mm);
  return left_handed;
}

HuVolume read_volume_file(const fs::path& path, uint64_t max_bytes) {
  const std::string name = path.string();
  if (!fs::exists(path)) throw Error(ErrorKind::not_found, "no such file: " + name);
  HuVolume volume;
  try {
    VolumeFile file(path);
    volume.warnings = file.header().warnings();
    const bool left_handed = file.place(volume);
    check_bytes(volume, max_bytes, name);
    volume.hu = read_values(file);
    if (left_handed) reverse_last_axis(volume);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::invalid_input, name + " does not fit into memory");
  }
  volume.source = path.filename().string();
  return volume;
}

}  // namespace ream::reader
