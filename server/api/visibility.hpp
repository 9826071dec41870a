#pragma once
#include <optional>
#include <string>

#include "net/message.hpp"
#include "session/service/replay_service.hpp"
#include "session/service/session_service.hpp"
#include "study/feel_service.hpp"
#include "study/rating_service.hpp"

namespace ream::api {

/// Knows sessions by their ids.
class SessionFinder {
 public:
  virtual ~SessionFinder() = default;
  /// What a session or replay with that id is; none when there is none.
  virtual std::optional<session::SessionRequest> session_of(const std::string& id) const = 0;
  /// Whether the caller rates the session with that id, and is to see no more of it than its replay. A replay
  /// has an id of its own and is not hidden.
  virtual bool is_rated_by(const net::Caller& caller, const std::string& id) const = 0;
  virtual bool is_replay(const std::string& id) const = 0;
  /// Whether the caller may reach a session, but nothing that it has measured.
  virtual bool hides_results(const net::Caller& caller, const std::string& id) const = 0;
};

/// Those of a server, which outlive it.
class ServedSessions final : public SessionFinder {
 public:
  ServedSessions(const session::SessionService& sessions, const session::ReplayService& replays,
                 const study::RatingService& ratings, const study::FeelService& feel)
      : sessions_(sessions), replays_(replays), ratings_(ratings), feel_(feel) {}
  std::optional<session::SessionRequest> session_of(const std::string& id) const override;
  bool is_rated_by(const net::Caller& caller, const std::string& id) const override;
  bool is_replay(const std::string& id) const override { return replays_.has(id); }
  bool hides_results(const net::Caller& caller, const std::string& id) const override;

 private:
  const session::SessionService& sessions_;
  const session::ReplayService& replays_;
  const study::RatingService& ratings_;
  const study::FeelService& feel_;
};

/// Whether a caller may know of a session: operators and instructors of all, trainees of their own, viewers
/// of the one their link is for or, when it is for none in particular, of all.
bool may_see(const net::Caller& caller, const session::SessionRequest& session);

/// For whom the places of jobs and replays that a caller takes are counted: the user or link of trainees and
/// viewers; empty for operators and instructors, who may take all.
std::string counted_for(const net::Caller& caller);

/// Error not_found, in the words of a session that does not exist.
[[noreturn]] void refuse_unseen(const std::string& id);

}  // namespace ream::api
