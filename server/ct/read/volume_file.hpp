#pragma once
#include <itkImageIOBase.h>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "ct/hu_volume.hpp"

namespace ream::ct {

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
  /// what depends on it. Throws Error io when the temporary file cannot be written.
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

/// Whether the name is that of a NRRD, NIfTI or MetaImage file.
bool is_volume_file(const std::filesystem::path& path);

/// The library's reader and writer of such a file. Error invalid_input for other names, says which there are.
itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& path);

/// First sentence of an ITK exception, without its source place and line breaks.
std::string short_reason(const itk::ExceptionObject& e);

/// A NRRD, NIfTI or MetaImage file of one value a voxel, opened: its header is known and holds, its voxels
/// are there. Errors of all members: invalid_input, one line naming the file and the reason.
class VolumeFile {
 public:
  explicit VolumeFile(const std::filesystem::path& path);

  const std::string& name() const { return name_; }  ///< for messages
  VolumeHeader& header() { return header_; }
  uint64_t image_bytes() const { return static_cast<uint64_t>(io_->GetImageSizeInBytes()); }
  unsigned value_bytes() const { return io_->GetComponentSize(); }
  unsigned values_per_voxel() const { return io_->GetNumberOfComponents(); }
  itk::IOComponentEnum type() const { return io_->GetComponentType(); }

  /// Reads all values as they are, image_bytes() of them.
  void read(void* to);

  /// Sets dims, spacing and pose. True when the file is left-handed: its last axis must be reversed.
  bool place(HuVolume& volume) const;

 private:
  std::string name_;
  itk::ImageIOBase::Pointer io_;
  VolumeHeader header_;
};

/// Calls use with the bytes as a pointer to values of that type. Throws Error invalid_input for a type that
/// is no number.
template <typename Use>
void with_values(itk::IOComponentEnum type, const char* bytes, const std::string& name, Use&& use) {
  using Type = itk::IOComponentEnum;
  const auto as = [&]<typename T>(T) { use(reinterpret_cast<const T*>(bytes)); };
  switch (type) {
    case Type::UCHAR: return as(uint8_t{});
    case Type::CHAR: return as(int8_t{});
    case Type::USHORT: return as(uint16_t{});
    case Type::SHORT: return as(int16_t{});
    case Type::UINT: return as(uint32_t{});
    case Type::INT: return as(int32_t{});
    case Type::ULONG:
    case Type::ULONGLONG: return as(uint64_t{});
    case Type::LONG:
    case Type::LONGLONG: return as(int64_t{});
    case Type::FLOAT: return as(float{});
    case Type::DOUBLE: return as(double{});
    default: throw Error(ErrorKind::invalid_input, name + " holds voxels of an unknown type");
  }
}

}  // namespace ream::ct
