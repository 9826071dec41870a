#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "bench/baselines/thesis_mesher.hpp"
#include "geometry/vec.hpp"

namespace ream::bench {

/// One of the thesis' models (table 2.2), to be imitated: same grid, same number of voxels.
struct ThesisModel {
  const char* name;
  Vec3 spacing_mm;
  Vec3i dims;
  double voxels;
  double thesis_sum_ms, thesis_memory_mb;  ///< tables 2.3 and 2.4
  double thesis_phases_ms[6];              ///< table 2.3; 0: not measured
  bool binned;
};
const std::vector<ThesisModel>& thesis_models();

/// A synthetic foam, the walls of a gyroid, with a smooth gray value from 300 to 1500: all that it is follows
/// from dims and the number of voxels.
class Foam {
 public:
  /// Within 1 % of so many voxels.
  Foam(const Vec3i& dims, const Vec3& spacing_mm, double voxels);

  const Vec3i& dims() const { return dims_; }
  const Vec3& spacing_mm() const { return spacing_mm_; }
  uint64_t voxels() const { return voxels_; }
  /// Gray value of a voxel, 0 where it is empty.
  uint16_t gray(int u, int v, int w) const;
  /// Calls use(u, v, w, gray) for every voxel of bone, x fastest.
  template <typename Use>
  void each(Use&& use) const {
    for (int w = 0; w < dims_.z(); ++w)
      for (int v = 0; v < dims_.y(); ++v)
        for (int u = 0; u < dims_.x(); ++u)
          if (const uint16_t g = gray(u, v, w)) use(u, v, w, g);
  }
  std::vector<VoxelRow> rows() const;
  /// The thesis' text file.
  void write_rows(const std::filesystem::path& path) const;
  /// A NRRD of 16 bits, unpacked.
  void write_nrrd(const std::filesystem::path& path) const;

 private:
  float field(int u, int v, int w) const;

  Vec3i dims_;
  Vec3 spacing_mm_;
  std::vector<float> sin_[3], cos_[3];
  float wall_ = 0.0f;
  uint64_t voxels_ = 0;
};

}  // namespace ream::bench
