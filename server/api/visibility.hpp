#pragma once
#include <functional>
#include <optional>
#include <string>

#include "net/message.hpp"
#include "session/running_session.hpp"

namespace ream::api {

/// What a session or replay with that id is; none when there is none.
using SessionFinder = std::function<std::optional<session::SessionRequest>(const std::string& id)>;

/// Whether a caller may know of a session: operators and instructors of all, trainees of their own, viewers
/// of the one their link is for or, when it is for none in particular, of all.
bool may_see(const net::Caller& caller, const session::SessionRequest& session);

/// Error not_found, in the words of a session that does not exist.
[[noreturn]] void refuse_unseen(const std::string& id);
/// The same unless the caller may see it.
void require_may_see(const net::Caller& caller, const session::SessionRequest& session);

}  // namespace ream::api
