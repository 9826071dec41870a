// Writes proto/golden/recording-N.ream and notes the structure of the manifest, N being its revision: once,
// when a revision is made. Not a test.
#include <cstdio>

#include "support/example_log.hpp"
#include "support/places.hpp"
#include "support/recording_manifest.hpp"

int main() {
  using namespace ream;
  const auto path = test::golden_recording(record::ops::newest_revision);
  std::filesystem::remove(path);
  test::write_example_log(record::create_log_file(path));
  auto structures = test::recorded_structures();
  structures[std::to_string(record::ops::newest_revision)] = test::structure_hash(test::recording_manifest());
  write_file_atomically(test::source_folder() + "/proto/golden/recording_structures.json",
                        structures.dump(2) + "\n");
  std::printf("%s\n", path.c_str());
}
