#include "api/recorded_annotations.hpp"

#include "api/annotation_op.hpp"
#include "api/session_folder.hpp"
#include "core/error.hpp"
#include "record/append_notes.hpp"
#include "record/recording.hpp"

namespace ream::api {

std::vector<Annotation> recorded_annotations(const std::filesystem::path& folder) {
  std::vector<Annotation> annotations;
  std::error_code failed;
  if (!std::filesystem::exists(recording_file(folder), failed)) return annotations;
  const record::Recording recording(recording_file(folder));
  for (const record::ops::Annotation& op : recording.annotations()) annotations.push_back(annotation_of(op));
  return annotations;
}

Annotation annotate_recording(const std::filesystem::path& folder, const NewAnnotation& note) {
  const auto lock = FileLock::attempt(lock_file(folder));
  if (!lock)
    throw Error(ErrorKind::conflict,
                "session '" + folder.filename().string() + "' is in use by another process");
  const record::Recording recording(recording_file(folder));
  const record::ops::Annotation op = annotation_op(note, recording.tick_count());
  record::append_notes(recording.log(), {{op}});
  return annotation_of(op);
}

}  // namespace ream::api
