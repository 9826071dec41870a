// A NRRD, NIfTI or MetaImage file: what its header is taken for, held against what the library makes of it.
#include <cstring>
#include <fstream>
#include <vector>

#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/ct_files.hpp"
#include "reader/volume_file.hpp"

namespace ream::fuzz {
namespace {

constexpr const char* names[] = {"a.nrrd", "a.nhdr", "a.nii", "a.nii.gz", "a.mha", "a.mhd"};
/// Deflate packs a byte into no less than that part of it.
constexpr uint64_t max_packing = 1100;

/// Voxels that lie plainly in the file are the ones that the library reads.
void compare(const std::filesystem::path& path, uint64_t file_bytes) {
  reader::VolumeFile file(path);
  const uint64_t bytes = file.image_bytes();
  require(bytes <= max_packing * file_bytes, "more voxels were taken than the file can hold");
  std::vector<char> read(bytes);
  file.read(read.data());
  const uint64_t begin = file.header().raw_begin(bytes);
  if (begin == 0) return;
  require(begin <= file_bytes && bytes <= file_bytes - begin, "raw voxels lie outside the file");
  std::vector<char> raw(bytes);
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(begin));
  in.read(raw.data(), static_cast<std::streamsize>(bytes));
  require(raw == read, "the library reads other voxels than lie there");
}

}  // namespace
}  // namespace ream::fuzz

namespace {

/// Headers that are rewritten for the library lie in the working folder.
class WorkingIn {
 public:
  explicit WorkingIn(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~WorkingIn() { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::folder().clear();
  const WorkingIn working(fuzz::folder().path());
  fuzz::Input input(data, size);
  const auto* name = fuzz::names[input.byte() % std::size(fuzz::names)];
  const std::string_view bytes = input.rest();
  const auto path = fuzz::folder().write(name, bytes);
  try {
    fuzz::compare(path, bytes.size());
  } catch (const Error&) {
  }
  try {
    const ct::HuVolume volume = reader::read_volume_file(path);
    fuzz::require(volume.hu.size() == volume.voxel_count(), "there are not as many values as voxels");
    fuzz::require(volume.spacing_mm.allFinite() && volume.spacing_mm.minCoeff() > 0.0,
                  "voxels without a size");
  } catch (const Error&) {
  }
  return 0;
}
