#pragma once
#include <itkImageIOBase.h>

#include <array>

#include "ct/hu_volume.hpp"

namespace ream::ct {

/// Where an image file says its voxels are: ITK's convention, LPS, origin at the centre of the first voxel.
struct ItkGeometry {
  Vec3i dims = Vec3i::Zero();
  Vec3 spacing_mm = Vec3::Ones(), origin_mm = Vec3::Zero();
  Mat3 direction = Mat3::Identity();  ///< columns are the voxel axes
};

ItkGeometry geometry_of(const itk::ImageIOBase& io);

/// All values of the opened image, clamped to 16 bits. `place` names the file in errors; a short file throws
/// Error.
std::vector<int16_t> read_values(itk::ImageIOBase& io, const std::string& place);

/// Puts dims, spacing and pose into `volume`, reversing the last axis of a left-handed image. Throws Error
/// invalid_input when the axes are not perpendicular or the spacing is not positive.
void set_geometry(HuVolume& volume, const ItkGeometry& geometry, const std::string& place);

/// Prepares `io` to write the volume as 16-bit scalars.
void describe(itk::ImageIOBase& io, const HuVolume& volume);

/// First sentence of an ITK exception, without its source place and line breaks.
std::string short_reason(const itk::ExceptionObject& e);

}  // namespace ream::ct
