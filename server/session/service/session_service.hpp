#pragma once
#include <chrono>
#include <cstddef>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "session/annotation.hpp"
#include "session/folder/session_archive.hpp"
#include "session/folder/session_labels.hpp"
#include "session/folder/session_register.hpp"
#include "session/folder/session_trash.hpp"
#include "session/running_session.hpp"
#include "session/service/session_engine.hpp"

namespace ream::session {

struct SessionLimits {
  size_t live = 4;        ///< created, running or paused at once
  size_t kept = 16;       ///< ended ones that can still be looked at; the oldest go first
  size_t of_trainee = 2;  ///< live ones that one trainee may have made
  std::optional<std::chrono::minutes> unstarted{10};  ///< what nobody starts for so long ends; none: never
  /// What is paused for so long without a break, by a person or without its device, ends; none: never.
  std::optional<std::chrono::minutes> paused{30};
};

/// Owns the sessions of this server and knows all that lie in the data folder. Thread-safe. Unknown ids throw
/// Error not_found.
class SessionService {
 public:
  /// `engine` outlives it. `sessions_folder`: where sessions keep their folders; empty: nowhere. `database`:
  /// has the index of sessions; outlives it.
  SessionService(SessionEngine& engine, SessionLimits limits, const std::filesystem::path& sessions_folder,
                 store::Database& database);
  ~SessionService();
  SessionService(const SessionService&) = delete;
  SessionService& operator=(const SessionService&) = delete;

  /// `wanted.id` is chosen here. `by_trainee`: it is the trainee who asks. Errors: unavailable when as many
  /// are live as may be; conflict when as many of that trainee are; those of the engine.
  SessionRecord create(SessionRequest wanted, bool by_trainee = false);
  /// Those of this server that are still held in memory, oldest first.
  std::vector<SessionRecord> held() const;
  /// Of all in the data folder, as SessionRegister::list().
  SessionPage list(const store::SessionQuery& query) const;
  SessionRecord get(const std::string& id) const;
  /// Starts one that was created, or goes on with one that was paused by pause(). Error conflict otherwise.
  SessionRecord start(const std::string& id);
  /// Takes the force away until start(). Error conflict unless it runs, or is paused by its device.
  SessionRecord pause(const std::string& id);
  /// Error conflict when it has ended already.
  SessionRecord stop(const std::string& id);
  /// Another attempt from intact bone: ends the session, if it has not, and makes a new one with the same
  /// settings and labels, which runs if the old one did. Those who watch the old one are told where it goes
  /// on. Errors: conflict when that was done before, or the session lives in another process; those of
  /// create(), after which the old one is as it was.
  SessionRecord reset(const std::string& id, bool by_trainee = false);
  /// Errors: those of relabel_folder().
  SessionRecord change(const std::string& id, const SessionChange& change);
  /// Goes on with one that was interrupted or stopped, under the same id, and starts it. `reamer`: empty for
  /// the same as before. Errors: conflict in any other state or when another process has it; those of
  /// create() and start().
  SessionRecord resume(const std::string& id, const std::string& reamer, bool by_trainee = false);
  /// Deletes one that has ended: it goes to the trash. Error conflict while it is live or in use, or is to be
  /// kept for good.
  SessionRecord remove(const std::string& id);
  /// Takes it out of the trash. Error conflict when it is not deleted.
  SessionRecord restore(const std::string& id);
  /// Those in the trash, lately deleted ones first.
  std::vector<DeletedSession> deleted() const;
  /// Takes a deleted one away for good.
  void erase(const std::string& id);
  /// Of a live one as they are now, else as metrics.json has them. Error not_found when it left none.
  nlohmann::json metrics(const std::string& id) const;
  /// What lies in the folder of one that has ended was written anew.
  void note_results(const std::string& id);
  /// Into the running recording, or behind the end of one that has ended. Error conflict before the start
  /// and while it is being resumed.
  Annotation annotate(const std::string& id, const NewAnnotation& note);
  std::vector<Annotation> annotations(const std::string& id) const;
  /// Where its files lie; there are none before its start.
  std::filesystem::path folder_of(const std::string& id) const;
  /// Of a live one, as RunningSession::write_surface and write_picture. Error conflict when it is only in its
  /// folder.
  void write_surface(const std::string& id, const std::filesystem::path& ply, int stride) const;
  void write_picture(const std::string& id, const std::filesystem::path& png) const;
  /// The session lives on as long as somebody watches it. `stride` as RunningSession::subscribe. Error
  /// conflict when it is only in its folder.
  std::unique_ptr<net::WebSocketSession> subscribe(const std::string& id, int stride) const;

  /// A client becomes the session's device, see RunningSession::connect_device. Error conflict when the
  /// session is only in its folder.
  std::unique_ptr<net::WebSocketSession> connect_device(const std::string& id) const;

  /// Ends those that were made longer ago than SessionLimits::unstarted and never started, and those that
  /// every call has found paused for SessionLimits::paused.
  void end_unused(std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now());

  /// Stops every session that still runs; nothing can be created or started any more. One whose loop stands
  /// still is held to the end of the service, also when it is deleted.
  void shut_down();

 private:
  struct Entry;
  class ViewerSocket;
  std::shared_ptr<Entry> find_or_none(const std::string& id) const;
  std::shared_ptr<Entry> find(const std::string& id) const;
  SessionRecord archived(const std::string& id) const;
  SessionRecord with_mark(SessionRecord held) const;
  std::shared_ptr<Entry> reopen_entry(const SessionRecord& before, const std::string& reamer);
  std::shared_ptr<Entry> create_entry(SessionRequest wanted, bool by_trainee, size_t leaving);
  SessionRequest next_attempt(const SessionRecord& before) const;
  SessionRecord restart(const SessionRecord& before, bool by_trainee);
  void relabel(const std::string& id, const SessionRequest& labels);
  void reserve_place(const std::string& trainee_id, bool by_trainee, size_t leaving = 0);
  void free_place(const std::string& trainee_id);
  std::string unused_id() const;
  std::optional<Annotation> annotate_live(const std::string& id, const NewAnnotation& note);
  std::vector<std::shared_ptr<Entry>> take_surplus();

  SessionEngine& engine_;
  const SessionLimits limits_;
  const SessionArchive archive_;
  SessionTrash trash_;
  mutable SessionRegister register_;  ///< a list mends it where the folders know better
  std::mutex annotating_;             ///< one remark behind an end at a time; locked before mutex_
  std::mutex labelling_;              ///< one change of labels at a time; locked before mutex_
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<Entry>> entries_;  ///< oldest first
  /// Deleted, but their loops stand still: not to be destroyed while others run.
  std::vector<std::shared_ptr<Entry>> standing_;
  std::set<std::string> being_resumed_, being_reset_;
  std::multiset<std::string> being_made_;  ///< by who trains
  bool closed_ = false;
};

}  // namespace ream::session
