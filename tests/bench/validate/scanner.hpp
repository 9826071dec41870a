#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/vec.hpp"

namespace ream::bench {

/// How a CT is taken. Blur is a Gaussian in all directions (SD 0.3 mm: 0.7 mm full width at half maximum, a
/// sharp bone kernel); a voxel is the mean over its own volume.
struct ScanProtocol {
  const char* name;
  double pixel_mm, slice_mm;
  double blur_mm = 0.3;    ///< standard deviation
  double noise_hu = 20.0;  ///< standard deviation, independent from voxel to voxel
};

/// A CT, x fastest, slices along z; `corner_mm`: of the first voxel, LPS.
struct Scan {
  Vec3i dims;
  Vec3 spacing_mm, corner_mm;
  std::vector<int16_t> hu;
};

/// A scanner that shares nothing with the product's phantoms: what is true is asked at points that are at
/// most 0.2 mm apart (`true_hu`, called by several threads), blurred, averaged over voxels, made noisy by
/// `seed` and rounded to whole HU.
Scan take_scan(const std::function<double(const Vec3& world_mm)>& true_hu, const Aabb& field_mm,
               const ScanProtocol& protocol, uint64_t seed);

/// As a NRRD file of raw 16-bit values.
void write_nrrd(const Scan& scan, const std::filesystem::path& path);

}  // namespace ream::bench
