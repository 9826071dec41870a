#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "voxel/voxel_grid.hpp"

namespace ream::voxel {

/// Bytes that copies share: a case that several sessions ream keeps its density once. Reading is as of a
/// const vector; who writes asks for writable(), which copies first when others share.
class SharedBytes {
 public:
  SharedBytes() = default;
  SharedBytes(std::vector<uint8_t> bytes)  // NOLINT: a vector is what bytes come from
      : bytes_(std::make_shared<std::vector<uint8_t>>(std::move(bytes))) {}

  size_t size() const { return bytes_ ? bytes_->size() : 0; }
  bool empty() const { return size() == 0; }
  const uint8_t* data() const { return bytes_ ? bytes_->data() : nullptr; }
  uint8_t operator[](size_t i) const { return (*bytes_)[i]; }
  const uint8_t* begin() const { return data(); }
  const uint8_t* end() const { return data() + size(); }

  /// Not while another thread copies or reads this object.
  std::vector<uint8_t>& writable() {
    if (!bytes_) bytes_ = std::make_shared<std::vector<uint8_t>>();
    if (bytes_.use_count() > 1) bytes_ = std::make_shared<std::vector<uint8_t>>(*bytes_);
    return *bytes_;
  }
  /// Whether both are one and the same memory.
  bool shares_with(const SharedBytes& other) const { return bytes_ == other.bytes_; }

  bool operator==(const SharedBytes& other) const {
    return bytes_ == other.bytes_ || (size() == other.size() && std::equal(begin(), end(), other.begin()));
  }

 private:
  friend class WatchedBytes;
  std::shared_ptr<std::vector<uint8_t>> bytes_;
};

/// Bytes that somebody else keeps: get() is empty once nobody does.
class WatchedBytes {
 public:
  WatchedBytes() = default;
  explicit WatchedBytes(const SharedBytes& bytes) : bytes_(bytes.bytes_) {}
  bool gone() const { return bytes_.expired(); }
  SharedBytes get() const {
    SharedBytes bytes;
    bytes.bytes_ = bytes_.lock();
    return bytes;
  }

 private:
  std::weak_ptr<std::vector<uint8_t>> bytes_;
};

enum class BoneClass : uint8_t { cancellous = 0, cortical = 1, cartilage = 2 };
inline constexpr int bone_class_count = 3;

/// Density byte of a voxel. Codes 0..250 are apparent density in steps of 0.01 g/cc (range 0 to 2.50 g/cc);
/// code 255 marks cartilage, which density cannot tell from bone; 251..254 are unused.
inline constexpr double density_step_g_cc = 0.01;
inline constexpr int max_density_code = 250;
inline constexpr uint8_t cartilage_code = 255;
/// Density given to cartilage where a number is needed (wet hyaline cartilage, about 1.1 g/cc).
inline constexpr double cartilage_density_g_cc = 1.1;
/// Where the thesis' two feed laws cross (eqs 5.1 and 5.2 give the same feed there).
inline constexpr double default_cortical_threshold_g_cc = 1.069;

uint8_t density_code(double density_g_cc);
double density_g_cc(uint8_t code);

/// Class of every density code for a cortical/cancellous threshold.
std::array<BoneClass, 256> class_table(double cortical_threshold_g_cc = default_cortical_threshold_g_cc);

/// Lowest code of cortical bone; those above, but for cartilage's own, are cortical too.
int32_t first_cortical_code(double cortical_threshold_g_cc);

/// Bone of one case: per voxel an unchanging density and what remains of the voxel. Coverage 255 is whole, 0
/// is gone or never was bone; the surface is where coverage crosses 127.5. Density is meaningful where the
/// coverage was ever above 0. Both arrays have grid.voxel_count() bytes in the order of VoxelGrid::index.
/// After a session has started only its haptic thread writes coverage; everybody else follows changed bricks.
struct BoneModel {
  VoxelGrid grid;
  SharedBytes density;  ///< copies of a bone share it
  std::vector<uint8_t> coverage;
  double cortical_threshold_g_cc = default_cortical_threshold_g_cc;

  /// Voxels with coverage of at least 128.
  size_t filled_voxels() const;
  /// Order-free hash of all coverage (sum over voxels); equal bones have equal hashes on every machine.
  uint64_t coverage_hash() const;
};

/// An empty bone of that grid. Throws as validate().
BoneModel make_bone(const VoxelGrid& grid);

/// Coverage at a point of the grid frame (mm), trilinear between voxel centres; 0 outside the grid.
double coverage_at(const BoneModel& bone, const Vec3& point_mm);
/// The same of a coverage that somebody else holds, grid.voxel_count() bytes.
double coverage_at(const VoxelGrid& grid, const uint8_t* coverage, const Vec3& point_mm);

}  // namespace ream::voxel
