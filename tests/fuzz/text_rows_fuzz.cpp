// Text rows x y z gray, as a CT and as gray values for meshes.
#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/ct_files.hpp"
#include "reader/gray_values.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  constexpr uint64_t max_bytes = 1 << 24;
  fuzz::Input input(data, size);
  const auto path = fuzz::folder().write("rows.txt", input.rest());
  try {
    const ct::HuVolume volume = reader::read_text_rows(path);
    fuzz::require(volume.hu.size() == volume.voxel_count(), "there are not as many values as voxels");
    fuzz::require(volume.spacing_mm.allFinite() && volume.spacing_mm.minCoeff() > 0.0,
                  "voxels without a size");
  } catch (const Error&) {
  }
  try {
    const auto& folder = fuzz::folder().path();
    std::filesystem::remove(folder / "given");
    std::filesystem::remove(folder / "values");
    reader::write_row_values(path, folder / "given", folder / "values", max_bytes, no_progress);
  } catch (const Error&) {
  }
  return 0;
}
