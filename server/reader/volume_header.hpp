#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ream::reader {

/// The header of a NRRD, NIfTI or MetaImage file, looked at before the reading library is: that one takes
/// memory for whatever is claimed, repairs silently, and hands out zeros for what is missing.
class VolumeHeader {
 public:
  /// Holds what is claimed against what it can be: whole positive numbers of voxels, at most max_ct_voxels,
  /// no more than the file can hold, positive finite voxel sizes, perpendicular axes (NIfTI), data in the
  /// file itself or in one beside it, axes that are known. Throws Error invalid_input naming the file and
  /// the reason; not_found where the file with the voxels is not there.
  explicit VolumeHeader(const std::filesystem::path& path);
  ~VolumeHeader();
  VolumeHeader(const VolumeHeader&) = delete;
  VolumeHeader& operator=(const VolumeHeader&) = delete;

  /// What is odd but can be used.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// What to give the library: the file itself, or a temporary header that names its voxels. The NRRD format
  /// lets the fields of a header stand in any order (but for `dimension`), the library wants `space` before
  /// what depends on it. The temporary file lies in the working folder. Throws Error io when it cannot be
  /// written.
  const std::filesystem::path& readable_path();

  /// Counts what is there, and checks the sums of what is packed; `image_bytes` is the size that the header
  /// promises. Throws Error invalid_input naming the file. What lies in another file of a NRRD or after
  /// skipped bytes is left to the library.
  void check_complete(uint64_t image_bytes) const;

  /// Where the voxels begin in a .nrrd or .mha file that holds them whole behind its header, unpacked and in
  /// this machine's byte order; 0 elsewhere.
  uint64_t raw_begin(uint64_t image_bytes) const;

 private:
  enum class Format { nrrd, nifti, meta };

  void check_nrrd();
  void check_meta();
  void check_nifti();
  std::string field(const char* key) const;

  std::filesystem::path path_, readable_, voxels_;  ///< voxels_: the file that holds them
  Format format_ = Format::nrrd;
  std::map<std::string, std::string> fields_;  ///< of a text header, keys without blanks
  std::vector<std::string> lines_;             ///< of a text header
  uint64_t end_ = 0;                           ///< byte behind a text header; 0: it has no end
  std::vector<std::string> warnings_;
};

/// The name that the header of a NRRD or MetaImage file gives for the file with the voxels; empty: they are
/// in the file itself. Nothing but lines is looked at. Errors as VolumeHeader's.
std::string voxel_file_named_in(const std::filesystem::path& header);

}  // namespace ream::reader
