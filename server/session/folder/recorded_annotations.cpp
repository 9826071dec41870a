#include "session/folder/recorded_annotations.hpp"

#include "core/error.hpp"
#include "core/log.hpp"
#include "record/op_log.hpp"
#include "session/annotation.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::session {

std::vector<Annotation> recorded_annotations(const std::filesystem::path& folder) {
  std::vector<Annotation> annotations;
  std::error_code failed;
  if (!std::filesystem::exists(recording_file(folder), failed)) return annotations;
  const record::Recording recording(recording_file(folder));
  if (const std::string& damage = recording.log().damage(); !damage.empty())
    log::warn("session " + folder.filename().string() + ": " + damage);
  for (const record::ops::Annotation& op : recording.annotations()) annotations.push_back(annotation_of(op));
  return annotations;
}

void require_recording(const std::filesystem::path& folder) {
  std::error_code failed;
  if (!std::filesystem::exists(recording_file(folder), failed))
    throw Error(ErrorKind::not_found,
                "session '" + folder.filename().string() + "' left no recording; it was never started");
}

void require_undamaged(const record::Recording& recording, const std::filesystem::path& folder) {
  const std::string& damage = recording.log().damage();
  // Behind the session's end there are only remarks, and only the newest can be torn.
  if (!damage.empty() && !recording.end())
    throw Error(ErrorKind::conflict,
                "session '" + folder.filename().string() +
                    "' cannot be written to any more, as its recording is damaged: " + damage);
}

Annotation annotate_recording(const std::filesystem::path& folder, const NewAnnotation& note) {
  require_recording(folder);
  const auto lock = FileLock::attempt(lock_file(folder));
  if (!lock)
    throw Error(ErrorKind::conflict,
                "session '" + folder.filename().string() + "' is in use by another process");
  const record::Recording recording(recording_file(folder));
  require_undamaged(recording, folder);
  const record::ops::Annotation op = annotation_op(note, recording.tick_count());
  record::append_notes(recording.log(), {{op}});
  return annotation_of(op);
}

}  // namespace ream::session
