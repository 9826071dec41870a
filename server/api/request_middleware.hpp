#pragma once
#include <functional>
#include <optional>
#include <string>

#include "api/audit.hpp"
#include "api/change_feed.hpp"
#include "api/idempotency.hpp"
#include "api/request_contract.hpp"
#include "api/visibility.hpp"
#include "net/router.hpp"

namespace ream::api {

/// What stands around every route: requests are held against the contract, repeated ones get their first
/// answer, replies have entity tags, changes are told, and what deletes or takes out data is audited.
class RequestMiddleware {
 public:
  /// What is given outlives the frame.
  RequestMiddleware(const Contract& contract, Idempotency& idempotency, ChangeFeed& feed,
                    SessionFinder find_session, Audit audit);

  /// The frame outlives the router.
  void install(net::Router& router);

 private:
  net::Response answer(const net::Request& request, const std::string& pattern, const net::Handler& next);
  void tell(const net::Request& request, const std::string& pattern, const net::Response& response);

  const Contract& contract_;
  Idempotency& idempotency_;
  ChangeFeed& feed_;
  const SessionFinder find_session_;
  const Audit audit_;
};

}  // namespace ream::api
