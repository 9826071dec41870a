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

void Router::on(const std::string& method, const std::string& pattern, Handler handler) {
  entries_.push_back({method, pattern, segments_of(pattern), std::move(handler), {}});
}

void Router::on_websocket(const std::string& pattern, WebSocketHandler handler) {
  entries_.push_back({"GET", pattern, segments_of(pattern), upgrade_required, std::move(handler)});
}

void Router::otherwise(Handler handler) { otherwise_ = std::move(handler); }

void Router::guard(Gate gate) { gate_ = std::move(gate); }

void Router::pace_callers(Rate rate) { callers_ = std::make_shared<RateLimiter>(rate); }

void Router::wrap_websockets(WebSocketWrapper wrapper) { wrapper_ = std::move(wrapper); }

void Router::check(Check check) { check_ = std::move(check); }

void Router::around(Around around) { around_ = std::move(around); }

std::optional<Response> Router::admit(Request& request, const std::string& pattern) const {
  if (gate_) gate_(request, pattern);
  const Caller& caller = request.caller;
  const std::string& key = caller.user_id.empty() ? caller.credential : caller.user_id;
  if (!callers_ || key.empty()) return std::nullopt;
  const double wait_s = callers_->take(key);
  if (wait_s <= 0.0) return std::nullopt;
  return too_many_requests("too many requests of one user; wait and send fewer", wait_s);
}

Response Router::dispatch(Request& request) const {
  const std::vector<std::string> path = segments_of(request.path);
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  std::set<std::string> allowed;
  for (const Entry& entry : entries_) {
    if (!matches(entry.segments, path)) continue;
    if (entry.method == method) {
      take_parameters(entry.segments, path, request);
      if (auto refusal = admit(request, entry.pattern)) return *refusal;
      if (check_) check_(request, entry.pattern);
      return around_ ? around_(request, entry.pattern, entry.handler) : entry.handler(request);
    }
    allowed.insert(entry.method);
    if (entry.method == "GET") allowed.insert("HEAD");
  }
  if (!allowed.empty()) return method_not_allowed(request, allowed);
  if (!otherwise_) throw Error(ErrorKind::not_found, "nothing is served at " + request.path);
  if (method != "GET") return method_not_allowed(request, {"GET", "HEAD"});
  if (auto refusal = admit(request, {})) return *refusal;
  return otherwise_(request);
}

Response Router::respond(Request request) const {
  try {
    return dispatch(request);
  } catch (const std::exception& failure) {
    return problem_of(failure);
  }
}

Router::Opened Router::open(Request request) const {
  try {
    const std::vector<std::string> path = segments_of(request.path);
    for (const Entry& entry : entries_) {
      if (!entry.websocket_handler || !matches(entry.segments, path)) continue;
      take_parameters(entry.segments, path, request);
      if (auto refusal = admit(request, entry.pattern)) return {nullptr, *refusal};
      if (check_) check_(request, entry.pattern);
      auto session = entry.websocket_handler(request);
      return {wrapper_ ? wrapper_(request, std::move(session)) : std::move(session), {}};
    }
    throw Error(ErrorKind::not_found, "no WebSocket is served at " + request.path);
  } catch (const std::exception& failure) {
    return {nullptr, problem_of(failure)};
  }
}

std::vector<Router::Route> Router::routes() const {
  std::vector<Route> list;
  for (const Entry& entry : entries_) list.push_back({entry.method, entry.pattern});
  return list;
}

}  // namespace ream::net
