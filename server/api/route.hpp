#pragma once
#include <memory>
#include <string>
#include <variant>

#include "access/role.hpp"
#include "net/message.hpp"
#include "net/websocket.hpp"
#include "net/worker_pool.hpp"

namespace ream::api {

struct Services;

/// Who may use a route: whoever has one of the roles. Which sessions somebody sees there is a finer matter
/// (visibility.hpp).
struct RouteAccess {
  enum class Kind {
    roles,
    anybody,     ///< without asking who it is
    monitoring,  ///< any bearer token and this machine itself, too: for programs that watch the server
  };
  constexpr RouteAccess(access::Roles may, Kind of_kind = Kind::roles) : roles(may), kind(of_kind) {}

  access::Roles roles;
  Kind kind;
};
inline constexpr RouteAccess for_anybody{0, RouteAccess::Kind::anybody};
inline constexpr RouteAccess for_monitoring{access::operators, RouteAccess::Kind::monitoring};

/// What is told to those who listen to changes when a request has succeeded: of the thing that its reply's
/// Location names, else of {id}.
struct RouteChange {
  const char* kind = nullptr;  ///< null: nothing is told, or whoever carries it out tells it
  const char* change = nullptr;
};

/// What the audit log keeps of a route's use. Every row has to say.
class RouteAudit {
 public:
  enum class Kind {
    nothing,     ///< neither changes what others rely on nor tells data of patients or trainees
    change,      ///< each time, with the action
    reading,     ///< once for each login and object
    by_handler,  ///< who handles it says more than the action
  };
  constexpr RouteAudit(Kind of_kind, const char* word) : kind(of_kind), action(word) {}

  Kind kind;
  const char* action;  ///< null where there is none
};
inline constexpr RouteAudit not_audited{RouteAudit::Kind::nothing, nullptr};
inline constexpr RouteAudit audited_by_handler{RouteAudit::Kind::by_handler, nullptr};
constexpr RouteAudit changes(const char* action) { return {RouteAudit::Kind::change, action}; }
constexpr RouteAudit reads(const char* action) { return {RouteAudit::Kind::reading, action}; }

using RequestHandler = net::Response (*)(const Services& services, const net::Request& request);
/// Opens the session of a WebSocket.
using SocketHandler = std::unique_ptr<net::WebSocketSession> (*)(const Services& services,
                                                                 const net::Request& request);

/// One route of the server. Its parameters, bodies and answers are those of openapi.yaml.
struct Route {
  std::string method, pattern;  ///< the method of a WebSocket is GET
  RouteAccess access;
  RouteAudit audit;
  std::variant<RequestHandler, SocketHandler> handler;
  RouteChange change = {};
  net::Urgency urgency = net::Urgency::usual;
  bool names_a_file = false;  ///< its answer holds a sender's file name, often a patient's: kept on no disk
};

}  // namespace ream::api
