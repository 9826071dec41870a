#include "net/router.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "net/problem.hpp"

namespace ream::net {
namespace {

std::vector<std::string> segments_of(std::string_view path) {
  std::vector<std::string> segments;
  for (size_t begin = 1; begin <= path.size();) {
    const size_t end = std::min(path.find('/', begin), path.size());
    segments.emplace_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return segments;
}

bool is_parameter(const std::string& segment) { return segment.size() > 2 && segment.front() == '{'; }

bool matches(const std::vector<std::string>& pattern, const std::vector<std::string>& path) {
  if (pattern.size() != path.size()) return false;
  for (size_t i = 0; i < pattern.size(); ++i)
    if (is_parameter(pattern[i]) ? path[i].empty() : pattern[i] != path[i]) return false;
  return true;
}

void take_parameters(const std::vector<std::string>& pattern, const std::vector<std::string>& path,
                     Request& request) {
  for (size_t i = 0; i < pattern.size(); ++i)
    if (is_parameter(pattern[i])) request.parameters[pattern[i].substr(1, pattern[i].size() - 2)] = path[i];
}

Response method_not_allowed(const Request& request, const std::set<std::string>& allowed) {
  std::string list;
  for (const std::string& method : allowed) list += (list.empty() ? "" : ", ") + method;
  Response response = problem(405, request.method + " is not possible at " + request.path + "; use " + list);
  response.headers.emplace_back("Allow", list);
  return response;
}

Response upgrade_required(const Request& request) {
  Response response = problem(426, request.path + " is a WebSocket; open it with an upgrade request");
  response.headers.emplace_back("Upgrade", "websocket");
  return response;
}

}  // namespace

void Router::on(const std::string& method, const std::string& pattern, Handler handler, Urgency urgency) {
  entries_.push_back({method, segments_of(pattern), std::move(handler), {}, urgency});
}

void Router::on_websocket(const std::string& pattern, WebSocketHandler handler) {
  entries_.push_back({"GET", segments_of(pattern), upgrade_required, std::move(handler)});
}

Urgency Router::urgency_of(const Request& request) const {
  const std::vector<std::string> path = segments_of(request.path);
  for (const Entry& entry : entries_)
    if (entry.method == request.method && matches(entry.segments, path)) return entry.urgency;
  return Urgency::usual;
}

void Router::otherwise(Handler handler) { otherwise_ = std::move(handler); }

void Router::pace_callers(Rate rate) { callers_ = std::make_shared<RateLimiter>(rate); }

std::optional<Response> Router::admit(Request& request, size_t route) const {
  if (policy_) policy_->authorize(request, route);
  const Caller& caller = request.caller;
  const std::string& key = caller.user_id.empty() ? caller.credential : caller.user_id;
  const double wait_s = callers_ && !key.empty() ? callers_->take(key) : 0.0;
  if (wait_s > 0.0) return too_many_requests("too many requests of one user; wait and send fewer", wait_s);
  if (policy_) policy_->check(request, route);
  return std::nullopt;
}

Response Router::dispatch(Request& request) const {
  const std::vector<std::string> path = segments_of(request.path);
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  std::set<std::string> allowed;
  for (size_t route = 0; route < entries_.size(); ++route) {
    const Entry& entry = entries_[route];
    if (!matches(entry.segments, path)) continue;
    if (entry.method == method) {
      take_parameters(entry.segments, path, request);
      if (auto refusal = admit(request, route)) return *refusal;
      return policy_ ? policy_->answer(request, route, entry.handler) : entry.handler(request);
    }
    allowed.insert(entry.method);
    if (entry.method == "GET") allowed.insert("HEAD");
  }
  if (!allowed.empty()) return method_not_allowed(request, allowed);
  if (!otherwise_) throw Error(ErrorKind::not_found, "nothing is served at " + request.path);
  if (method != "GET") return method_not_allowed(request, {"GET", "HEAD"});
  return otherwise_(request);
}

Response Router::respond(Request request) const {
  try {
    return dispatch(request);
  } catch (...) {
    return problem_of_current_exception();
  }
}

Router::Opened Router::open(Request request) const {
  try {
    const std::vector<std::string> path = segments_of(request.path);
    for (size_t route = 0; route < entries_.size(); ++route) {
      const Entry& entry = entries_[route];
      if (!entry.websocket_handler || !matches(entry.segments, path)) continue;
      take_parameters(entry.segments, path, request);
      if (auto refusal = admit(request, route)) return {nullptr, *refusal};
      auto session = entry.websocket_handler(request);
      return {policy_ ? policy_->opened(request, route, std::move(session)) : std::move(session), {}};
    }
    throw Error(ErrorKind::not_found, "no WebSocket is served at " + request.path);
  } catch (...) {
    return {nullptr, problem_of_current_exception()};
  }
}

}  // namespace ream::net
