#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "ct/hu_volume.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::ct {

/// A volume of gray values that need not be HU: micro-CT of 8 or 16 bits, densities, moduli. Values are kept
/// as codes of a scale, exactly where that can be (voxel::GrayScale).
class GrayVolume {
 public:
  /// A folder of DICOM slices, a NRRD, NIfTI or MetaImage file, text rows, or a zip archive of one, as
  /// read_ct takes them; but rows need not give every voxel. ream-reader writes the values into a temporary
  /// file, from which layers are read: memory here is a layer. What lies unpacked in a .nrrd or .mha file it
  /// reads layer by layer, everything else whole, unless that takes more than `max_bytes` of memory. Errors:
  /// those of read_ct; invalid_input that says what to do where it would take more. `reader`: as in
  /// ReadOptions.
  explicit GrayVolume(const std::filesystem::path& path, uint64_t max_bytes = UINT64_MAX,
                      const Progress& progress = no_progress, const std::filesystem::path& reader = {});
  ~GrayVolume();
  GrayVolume(GrayVolume&&) noexcept;
  GrayVolume& operator=(GrayVolume&&) noexcept;

  const Vec3i& dims() const;
  const Vec3& spacing_mm() const;
  const Pose& world_from_volume() const;
  const voxel::GrayScale& gray() const;
  const std::vector<std::string>& warnings() const;
  /// Whether only some voxels have a value, as in text rows of a segmented bone.
  bool partly_given() const;

  /// Codes of layer w, or no_code, x fastest, dims.x * dims.y of them. Thread-safe. Throws Error io.
  void read_layer(int w, std::span<int32_t> codes) const;
  static constexpr int32_t no_code = -1;

 private:
  struct Contents;
  std::unique_ptr<Contents> contents_;
};

}  // namespace ream::ct
