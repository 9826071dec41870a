#include "session/export/score_makers.hpp"

#include <memory>

#include "core/log.hpp"
#include "core/version.hpp"
#include "session/export/export_surfaces.hpp"
#include "session/folder/session_folder.hpp"
#include "session/scoring/rescoring.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

Measure measure_in(const fs::path& data) {
  return [rescorer = std::make_shared<Rescorer>(data)](const fs::path& folder, const Progress& progress) {
    const record::Recording recording(recording_file(folder), record::Recording::Trust::checked);
    if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
    return rescorer->metrics(recording, progress);
  };
}

}  // namespace

ScoreMakers score_makers(const fs::path& data) {
  return {version_text(), [data] { return measure_in(data); },
          [data](const fs::path& folder, const fs::path& json, const Progress& progress) {
            ExportRequest request;
            request.recording = recording_file(folder);
            request.data = data;
            write_deviations(request, json, progress);
          }};
}

}  // namespace ream::session
