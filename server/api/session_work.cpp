#include "api/session_work.hpp"

#include "api/visibility.hpp"

namespace ream::api {
namespace fs = std::filesystem;

void require_ended(const session::SessionRecord& record, const std::string& what) {
  if (is_live(record.status.state))
    throw Error(ErrorKind::conflict,
                "session '" + record.request.id + "' is " + to_text(record.status.state) + "; " + what);
}

FileLock lock_of_ended(const fs::path& folder) {
  auto lock = FileLock::attempt(session::lock_file(folder));
  if (!lock)
    throw Error(ErrorKind::conflict,
                "session '" + folder.filename().string() + "' is in use; try again later");
  return std::move(*lock);
}

jobs::JobRecord work_in_folder(jobs::JobService& jobs, const std::string& kind, const net::Caller& caller,
                               const session::SessionRecord& record, const fs::path& folder,
                               const std::function<void(const fs::path&, const Progress&)>& work) {
  const std::string& id = record.request.id;
  if (const auto open = jobs.open_on_session(kind, id)) return *open;
  const jobs::JobOrder order{
      kind, {}, id, std::make_shared<const session::SessionRequest>(record.request), counted_for(caller)};
  return jobs.submit(order, [folder, work](const Progress& progress) {
    const FileLock lock = lock_of_ended(folder);
    work(folder, progress);
  });
}

}  // namespace ream::api
