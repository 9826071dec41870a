// A DICOM file: its elements, what they say of a slice, its pixels, and the series of that one file.
#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "library_assert.hpp"
#include "reader/ct_files.hpp"
#include "reader/dicom_file.hpp"
#include "reader/dicom_slice.hpp"

namespace ream::fuzz {
namespace {

void read(const std::filesystem::path& path, size_t file_bytes) {
  const reader::DicomFile file = reader::parse_dicom(path);
  if (file.state != reader::DicomState::whole) return;
  const size_t held = file.inflated.empty() ? file_bytes : file.inflated.size();
  for (const auto& piece : file.pixels)
    require(piece.at <= held && piece.bytes <= held - piece.at, "pixels lie outside the file");
  for (const reader::DicomSlice& slice : reader::describe_dicom(path, file)) {
    if (slice.modality != "CT" || !slice.unusable.empty()) continue;
    require(slice.spacing_mm.allFinite() && slice.origin_mm.allFinite() && slice.spacing_mm.z() >= 0.0,
            "a usable slice lies nowhere");
    reader::DicomPixels pixels;
    require(pixels.hu(slice).size() == slice.pixels(), "there are not as many values as pixels");
  }
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const auto path = fuzz::folder().write("slice.dcm", input.rest());
  if (setjmp(fuzz::after_library_assert) != 0) return 0;
  try {
    fuzz::read(path, size);
    const ct::HuVolume volume = reader::read_ct_files(path);
    fuzz::require(volume.hu.size() == volume.voxel_count(), "there are not as many values as voxels");
  } catch (const Error&) {
  }
  return 0;
}
