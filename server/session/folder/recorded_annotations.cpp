#include "session/folder/recorded_annotations.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/file.hpp"
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

static FileLock lock_session(const std::filesystem::path& folder) {
  if (auto lock = FileLock::attempt(lock_file(folder))) return *std::move(lock);
  throw Error(ErrorKind::conflict,
              "session '" + folder.filename().string() + "' is in use by another process");
}

Annotation annotate_recording(const std::filesystem::path& folder, const NewAnnotation& note) {
  require_recording(folder);
  const FileLock lock = lock_session(folder);
  const record::Recording recording(recording_file(folder));
  require_undamaged(recording, folder);
  const record::ops::Annotation op = annotation_op(note, recording.tick_count());
  record::append_notes(recording.log(), {{op}});
  return annotation_of(op);
}

void forget_authors(const std::filesystem::path& folder, const std::vector<std::string>& authors) {
  std::error_code failed;
  if (!std::filesystem::exists(recording_file(folder), failed)) return;
  const auto is_theirs = [&](const auto& note) {
    return std::find(authors.begin(), authors.end(), note.author) != authors.end();
  };
  const std::filesystem::path path = recording_file(folder), anew = path.string() + ".tmp";
  const std::vector<record::ops::Annotation> notes = record::Recording(path).annotations();
  if (std::none_of(notes.begin(), notes.end(), is_theirs)) return;
  const FileLock lock = lock_session(folder);
  const record::Recording recording(path, record::Recording::Trust::checked);
  require_undamaged(recording, folder);
  std::filesystem::remove(anew, failed);  // of an attempt that was killed
  record::OpLogWriter writer(record::create_log_file(anew));
  for (size_t i = 0; i < recording.log().chunks().size(); ++i) {
    record::ops::read(recording.log().read_chunk(i), recording.log().revision(), [&](auto op) {
      if constexpr (std::is_same_v<decltype(op), record::ops::Annotation>)
        if (is_theirs(op)) op.author.clear();
      writer.add(op);
    });
    writer.close_chunk();
  }
  writer.sync();
  std::filesystem::rename(anew, path);
  sync_folder(folder);
}

}  // namespace ream::session
