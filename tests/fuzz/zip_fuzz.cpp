// A zip archive of a CT, and one of anything: nothing is written outside its folder.
#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/ct_source.hpp"
#include "store/zip_archive.hpp"

namespace ream::fuzz {
namespace {

namespace fs = std::filesystem;

void unpack(const fs::path& archive) {
  const fs::path inside = folder().path() / "inside";
  fs::create_directory(inside);
  store::UnpackLimits limits;
  limits.entries = 50;
  limits.bytes = 1 << 22;
  limits.durable = false;
  try {
    store::unpack_zip(archive, inside, limits);
  } catch (const Error&) {
  }
  uint64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(inside)) {
    require(!entry.is_symlink(), "a link was unpacked");
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  require(bytes <= limits.bytes, "more was unpacked than may be");
  for (const auto& entry : fs::directory_iterator(folder().path()))
    require(entry.path() == inside || entry.path() == archive, "something was written outside the folder");
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::folder().clear();
  fuzz::Input input(data, size);
  const auto archive = fuzz::folder().write("ct.zip", input.rest());
  fuzz::unpack(archive);
  try {
    store::zip_names(archive);
    const reader::CtSource source(archive, no_progress, fuzz::folder().path());
  } catch (const Error&) {
  }
  return 0;
}
