#pragma once
#include <optional>
#include <string>

#include "access/access_control.hpp"
#include "api/route.hpp"
#include "api/visibility.hpp"
#include "net/message.hpp"

namespace ream::api {

/// Who asks, and how that is known.
struct Visitor {
  net::Caller caller;
  std::optional<access::Identity> identity;  ///< none: nobody in particular
  std::string csrf_token;                    ///< of a cookie; else empty
};

/// Stands before every route: finds out who asks, by bearer token, else by cookie, and lets them pass as the
/// route's row says. Without users everybody passes, as an operator. Thread-safe.
class Authorizer {
 public:
  /// Both outlive it.
  Authorizer(access::AccessControl& access_control, const SessionFinder& sessions)
      : access_control_(access_control), sessions_(sessions) {}

  /// Sets the caller and takes what was shown out of the request. RequestErrors: 401 who are you, 403 not you
  /// (or a change by cookie without the token against forgery); Error not_found for a session that the caller
  /// may not see.
  void authorize(net::Request& request, const Route& route) const;

  /// For routes that are open: who asks, if they show anything good. RequestError 401 for a bad token; a bad
  /// cookie is none.
  Visitor visitor(const net::Request& request) const;

  /// RequestError 403 for a session that the caller rates.
  void require_unrated(const net::Caller& caller, const std::string& session) const;
  /// The same, and 403 where what the session measured is hidden from the caller.
  void require_results(const net::Caller& caller, const std::string& session) const;

  /// Whether the server lets in everybody.
  bool is_open() const { return !access_control_.users.any(); }

 private:
  void require_shown(const net::Caller& caller, const std::string& session) const;
  void require_sight(const net::Request& request, const Route& route) const;

  access::AccessControl& access_control_;
  const SessionFinder& sessions_;
};

/// RequestError 403 unless a request that changes something by its cookie shows the token against forgery,
/// and a WebSocket comes from a page of this server.
void require_no_forgery(const Visitor& visitor, const net::Request& request);

}  // namespace ream::api
