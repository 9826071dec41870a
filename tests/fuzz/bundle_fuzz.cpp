// What the reader process makes of a session bundle: the archive, the recording and the case in it.
#include <array>

#include "case/case.hpp"
#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/session_archive.hpp"
#include "store/zip_archive.hpp"

namespace ream::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::array members = {"bundle.json",      "session/session.json", "session/recording.ream",
                                "case/case.json",   "case/plan.json",       "case/density.zst",
                                "case/coverage.zst"};

/// Each member is a piece of the input; without a piece there is none.
fs::path archive_of(Input& input) {
  std::vector<store::ArchiveEntry> entries;
  for (size_t i = 0; i < members.size(); ++i) {
    const std::string_view bytes = input.piece();
    if (!bytes.empty()) entries.push_back({folder().write("member-" + std::to_string(i), bytes), members[i]});
  }
  const fs::path zip = folder().path() / "bundle.zip";
  store::write_zip(zip, entries);
  return zip;
}

/// Read twice it says the same, and of its case what the case itself says.
void read(const fs::path& zip) {
  const fs::path once = folder().path() / "once", twice = folder().path() / "twice";
  for (const fs::path& into : {once, twice}) fs::create_directory(into);
  const reader::SessionArchive first = reader::unpack_session(zip, once);
  const reader::SessionArchive second = reader::unpack_session(zip, twice);
  require(first.case_id == second.case_id && first.recorded_case == second.recorded_case &&
              first.enclosed_case == second.enclosed_case,
          "an archive is read in two ways");
  require(first.enclosed_case.has_value() == fs::exists(once / "case"), "a case was made up or lost");
  if (first.enclosed_case)
    require(*first.enclosed_case == case_::case_hash(case_::load_case(once / "case")),
            "the case is another one");
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::folder().clear();
  fuzz::Input input(data, size);
  try {
    const auto zip = fuzz::archive_of(input);
    reader::holds_session(zip);
    fuzz::read(zip);
  } catch (const Error&) {
  }
  return 0;
}
