#include "app/score_makers.hpp"

#include <memory>

#include "api/session_folder.hpp"
#include "app/export_surfaces.hpp"
#include "app/rescoring.hpp"
#include "app/version.hpp"
#include "core/log.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

api::Measure measure_in(const fs::path& data) {
  return [rescorer = std::make_shared<Rescorer>(data)](const fs::path& folder, const Progress& progress) {
    const record::Recording recording(api::recording_file(folder), record::Recording::Trust::checked);
    if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
    return rescorer->metrics(recording, progress);
  };
}

}  // namespace

api::ScoreMakers score_makers(const fs::path& data) {
  return {version_text(), [data] { return measure_in(data); },
          [data](const fs::path& folder, const fs::path& json, const Progress& progress) {
            ExportRequest request;
            request.recording = api::recording_file(folder);
            request.data = data;
            write_deviations(request, json, progress);
          }};
}

}  // namespace ream::app
