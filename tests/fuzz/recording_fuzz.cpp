// A recording's file: chunks, notes, ticks and checkpoints.
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "fuzz_input.hpp"
#include "record/recording.hpp"

namespace ream::fuzz {
namespace {

/// A file in memory that holds the bytes and has a path.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("recording", 0)) {
    require(::write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
            "no memory file");
  }
  ~MemoryFile() { ::close(descriptor_); }
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

void read(const std::filesystem::path& path, record::Recording::Trust trust) {
  const record::Recording recording(path, trust);
  uint32_t ticks = 0;
  recording.for_each_tick(0, recording.tick_count(), [&](const record::ops::Tick&) { ++ticks; });
  recording.checkpoints();
  if (recording.tick_count() > 0) recording.chunk_of(recording.tick_count() / 2);
  recording.grid();
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const fuzz::MemoryFile file(input.rest());
  for (const auto trust : {record::Recording::Trust::until_read, record::Recording::Trust::checked}) {
    try {
      fuzz::read(file.path(), trust);
    } catch (const Error&) {
    }
  }
  return 0;
}
