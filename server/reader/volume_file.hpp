#pragma once
#include <filesystem>

#include "core/error.hpp"
#include "ct/hu_volume.hpp"
#include "ct/read/image_io.hpp"
#include "reader/volume_header.hpp"

namespace ream::reader {

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
  bool place(ct::HuVolume& volume) const;

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

}  // namespace ream::reader
