#pragma once
#include "net/message.hpp"
#include "session/service/session_service.hpp"

namespace ream::api {

struct Services;

/// What of a list of sessions the filters, order and page of a query ask for; the contract has checked it.
store::SessionQuery session_query(const net::Request& request);

/// The sessions that a caller may see of those: trainees their own, viewers what their link is for. Who asks
/// for a person and may not know who is behind codes gets sessions outside of studies only. Errors:
/// invalid_input for a bad cursor; unavailable while the index cannot be asked.
session::SessionPage sessions_for(const Services& services, const net::Caller& caller,
                                  store::SessionQuery query);

/// GET /api/v1/sessions: a page of the sessions that the caller may see, as they may know them, and the
/// replays of such that are open. Errors: invalid_input for a bad cursor; unavailable while the index cannot
/// be asked.
net::Response list_sessions(const Services& services, const net::Request& request);

}  // namespace ream::api
