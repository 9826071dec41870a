#pragma once
#include "api/idempotency.hpp"
#include "api/request_contract.hpp"
#include "api/services.hpp"
#include "api/stream_watch.hpp"
#include "net/router.hpp"

namespace ream::api {

/// What stands around every route: who may not is refused, requests are held against the contract, repeated
/// ones get their first answer, replies have entity tags, changes are told, what the row says is audited, and
/// WebSockets end with what let them in.
class RequestMiddleware final : public net::RequestPolicy {
 public:
  /// What is given outlives it.
  RequestMiddleware(const Services& services, const SessionFinder& sessions, const Contract& contract,
                    Idempotency& idempotency, StreamWatch& stream_watch)
      : services_(services),
        sessions_(sessions),
        contract_(contract),
        idempotency_(idempotency),
        stream_watch_(stream_watch) {}

  /// Adds all routes to a router without any, and stands around them. It outlives the router.
  void install(net::Router& router) const;

  void authorize(net::Request& request, size_t route) const override;
  void check(net::Request& request, size_t route) const override;
  net::Response answer(const net::Request& request, size_t route, const net::Handler& next) const override;
  std::unique_ptr<net::WebSocketSession> opened(
      const net::Request& request, size_t route,
      std::unique_ptr<net::WebSocketSession> session) const override;

 private:
  net::Response audited(const net::Request& request, const Route& route, const net::Handler& handler) const;
  void publish_change(const net::Request& request, const Route& route, const net::Response& response) const;

  const Services& services_;
  const SessionFinder& sessions_;
  const Contract& contract_;
  Idempotency& idempotency_;
  StreamWatch& stream_watch_;
};

/// The change that a request to a route has made, once it was answered with `response`; none where nothing is
/// told. Of changes to a session the caller sets `session`.
std::optional<Change> change_made(const net::Request& request, const Route& route,
                                  const net::Response& response);

}  // namespace ream::api
