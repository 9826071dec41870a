#include "reader/session_archive.hpp"

#include <algorithm>

#include "case/case.hpp"
#include "core/error.hpp"
#include "record/recording.hpp"
#include "store/zip_archive.hpp"

namespace ream::reader {
namespace fs = std::filesystem;

bool holds_session(const fs::path& zip) {
  const auto names = store::zip_names(zip);
  return std::find(names.begin(), names.end(), "bundle.json") != names.end();
}

SessionArchive unpack_session(const fs::path& zip, const fs::path& folder, const Progress& progress) {
  store::UnpackLimits limits;
  limits.durable = false;  // whoever takes the files out of this folder syncs them
  store::unpack_zip(zip, folder, limits, progress);
  const record::Recording recording(folder / "session" / "recording.ream", record::Recording::Trust::checked);
  SessionArchive archive{recording.header().case_id, recording.header().case_hash, {}};
  if (fs::exists(folder / "case"))
    archive.enclosed_case = case_::case_hash(case_::load_case(folder / "case"));
  return archive;
}

}  // namespace ream::reader
