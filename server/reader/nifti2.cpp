#include "reader/nifti2.hpp"

#include <fcntl.h>
#include <nifti/nifti1.h>
#include <nifti/nifti2.h>
#include <stdlib.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"

namespace ream::reader {
namespace {

static_assert(sizeof(nifti_1_header) == nifti1_header_bytes && sizeof(nifti_2_header) == nifti2_header_bytes);

/// A number of the file, and one for it.
template <typename T>
T in_order(T value, bool swapped) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof value);
  if (swapped) std::reverse(raw, raw + sizeof value);
  std::memcpy(&value, raw, sizeof value);
  return value;
}

/// Copies numbers into narrower fields.
class Narrowing {
 public:
  Narrowing(bool swapped, const std::string& place) : swapped_(swapped), place_(place) {}

  template <typename To, typename From>
  void operator()(To& to, From from) const {
    const From value = in_order(from, swapped_);
    if constexpr (std::is_integral_v<To>)
      if (static_cast<From>(static_cast<To>(value)) != value)
        throw Error(ErrorKind::invalid_input, place_ + ": its header claims " + std::to_string(value) +
                                                  " voxels along an axis, or another number that is too "
                                                  "large; save it as NRRD");
    to = in_order(static_cast<To>(value), swapped_);
  }
  template <typename To, typename From, size_t count>
  void operator()(To (&to)[count], const From (&from)[count]) const {
    for (size_t i = 0; i < count; ++i) (*this)(to[i], from[i]);
  }

 private:
  bool swapped_;
  const std::string& place_;
};

struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose(file); }
};

}  // namespace

Nifti1Header nifti1_of(const std::string& header, bool swapped, const std::string& place) {
  nifti_2_header from;
  std::memcpy(&from, header.data(), sizeof from);
  nifti_1_header to{};
  const Narrowing narrow(swapped, place);
  narrow(to.sizeof_hdr, in_order(int32_t{nifti1_header_bytes}, swapped));
  narrow(to.dim, from.dim);
  narrow(to.pixdim, from.pixdim);
  narrow(to.datatype, from.datatype);
  narrow(to.bitpix, from.bitpix);
  narrow(to.scl_slope, from.scl_slope);
  narrow(to.scl_inter, from.scl_inter);
  narrow(to.qform_code, from.qform_code);
  narrow(to.sform_code, from.sform_code);
  narrow(to.quatern_b, from.quatern_b);
  narrow(to.quatern_c, from.quatern_c);
  narrow(to.quatern_d, from.quatern_d);
  narrow(to.qoffset_x, from.qoffset_x);
  narrow(to.qoffset_y, from.qoffset_y);
  narrow(to.qoffset_z, from.qoffset_z);
  narrow(to.srow_x, from.srow_x);
  narrow(to.srow_y, from.srow_y);
  narrow(to.srow_z, from.srow_z);
  narrow(to.xyzt_units, from.xyzt_units);
  narrow(to.vox_offset, in_order(int32_t{nifti1_voxels_begin}, swapped));
  std::memcpy(to.magic, "n+1", sizeof to.magic);
  const int64_t begin = in_order(from.vox_offset, swapped);
  constexpr int64_t least = nifti2_header_bytes, most = 1'000'000;
  if (begin < least || begin > most)
    throw Error(ErrorKind::invalid_input,
                place + ": its header claims that the voxels begin at byte " + std::to_string(begin));
  Nifti1Header result{static_cast<uint64_t>(begin), std::string(nifti1_voxels_begin, '\0')};
  std::memcpy(result.bytes.data(), &to, sizeof to);
  return result;
}

std::filesystem::path write_as_nifti1(const std::filesystem::path& path, const Nifti1Header& header,
                                      uint64_t voxel_bytes) {
  const std::unique_ptr<gzFile_s, CloseGz> in(gzopen(path.c_str(), "rb"));
  if (!in) throw Error(ErrorKind::io, "cannot read " + path.string());
  std::string name = (std::filesystem::current_path() / "ream-XXXXXX.nii").string();
  constexpr int ending_bytes = 4;
  const FileDescriptor made(::mkostemps(name.data(), ending_bytes, O_CLOEXEC));
  std::ofstream out(name, std::ios::binary);
  out << header.bytes;
  bool whole = gzseek(in.get(), static_cast<z_off_t>(header.voxels_begin), SEEK_SET) >= 0;
  std::vector<char> piece(1 << 20);
  for (uint64_t left = voxel_bytes; whole && left > 0 && out;) {
    const auto wanted = static_cast<unsigned>(std::min<uint64_t>(left, piece.size()));
    whole = gzread(in.get(), piece.data(), wanted) == static_cast<int>(wanted);
    out.write(piece.data(), wanted);
    left -= wanted;
  }
  if (!whole)
    throw Error(ErrorKind::invalid_input,
                path.string() + " is cut short or damaged; copy it again from its source");
  if (!out.flush()) throw Error(ErrorKind::io, "cannot write " + name);
  return name;
}

}  // namespace ream::reader
