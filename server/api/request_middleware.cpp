#include "api/request_middleware.hpp"

#include "api/audit_rules.hpp"
#include "api/change_rules.hpp"
#include "core/log.hpp"
#include "net/conditional.hpp"

namespace ream::api {

RequestMiddleware::RequestMiddleware(const Contract& contract, Idempotency& idempotency, ChangeFeed& feed,
                                     SessionFinder find_session, Audit audit)
    : contract_(contract),
      idempotency_(idempotency),
      feed_(feed),
      find_session_(std::move(find_session)),
      audit_(std::move(audit)) {}

void RequestMiddleware::install(net::Router& router) {
  router.check(
      [this](const net::Request& request, const std::string& pattern) { contract_.check(request, pattern); });
  router.around([this](const net::Request& request, const std::string& pattern, const net::Handler& next) {
    return answer(request, pattern, next);
  });
}

net::Response RequestMiddleware::answer(const net::Request& request, const std::string& pattern,
                                        const net::Handler& next) {
  const net::Handler done = [&](const net::Request& passed) {
    net::Response response = next(passed);
    tell(passed, pattern, response);
    audit_change(audit_, passed, pattern, response);
    return response;
  };
  if (contract_.takes_idempotency_key(request.method, pattern)) return idempotency_.answer(request, done);
  return net::conditional(request, done(request));
}

/// The change was made; that it cannot be told is no reason to say it failed.
void RequestMiddleware::tell(const net::Request& request, const std::string& pattern,
                             const net::Response& response) {
  try {
    auto change = change_made(request, pattern, response);
    if (!change) return;
    if (change->kind == "session" || change->kind == "replay")
      if (auto session = find_session_(request.parameters.at("id")))
        change->session = std::make_shared<const session::SessionRequest>(std::move(*session));
    feed_.tell(*change);
  } catch (const std::exception& failure) {
    log::warn(std::string("a change could not be told: ") + failure.what());
  }
}

}  // namespace ream::api
