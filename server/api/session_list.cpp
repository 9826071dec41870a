#include "api/session_list.hpp"

#include <nlohmann/json.hpp>

#include "access/role.hpp"
#include "api/json_page.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/services.hpp"
#include "api/visibility.hpp"
#include "core/error.hpp"
#include "session/folder/session_folder.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

std::optional<double> number_of(const net::Request& request, const std::string& name) {
  return request.query.contains(name) ? std::optional(query_number(request, name, 0.0)) : std::nullopt;
}

std::vector<std::string> parts_of(const std::string& list) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin < list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Moments that begin so are at or behind it, with parts of a second or without.
std::string beginning_of(const net::Request& request, const std::string& name) {
  std::string moment = query_text(request, name);
  if (moment.ends_with('Z')) moment.pop_back();
  return moment;
}

/// Of one that a viewer's link is for.
session::SessionPage only(const session::SessionService& sessions, const store::SessionQuery& query,
                          const std::string& id) {
  session::SessionPage page;
  try {
    session::SessionRecord record = sessions.get(id);
    if (query.cursor.empty() && matches(query, row_of(record))) page.sessions.push_back(std::move(record));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::not_found) throw;
  }
  page.total = page.sessions.size();
  return page;
}

json visible_replays(const Services& services, const net::Caller& caller) {
  json visible = json::array();
  for (const session::ReplayRecord& record : services.replays.list()) try {
      if (record.request.blind) continue;
      const session::SessionRequest of = services.sessions.get(record.request.replay_of).request;
      if (may_see(caller, of) && !services.feel.hides(caller, of)) visible.push_back(to_json(record));
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::not_found) throw;
    }
  return visible;
}

}  // namespace

store::SessionQuery session_query(const net::Request& request) {
  store::SessionQuery query;
  query.states = parts_of(query_text(request, "state"));
  query.case_id = query_text(request, "case");
  query.trainee_id = query_text(request, "trainee");
  query.study = query_text(request, "study");
  query.participant = query_text(request, "participant");
  query.created_from = beginning_of(request, "from");
  query.created_before = beginning_of(request, "to");
  query.outcomes = parts_of(query_text(request, "outcome"));
  query.points_from = number_of(request, "points_from");
  query.points_to = number_of(request, "points_to");
  query.text = query_text(request, "q");
  query.cursor = query_text(request, "cursor");
  query.limit = limit_of(request);
  const std::string sort = query_text(request, "sort", "-created_utc");
  query.descending = sort.starts_with('-');
  query.order = store::session_order_from(query.descending ? sort.substr(1) : sort)
                    .value_or(store::SessionOrder::created);
  return query;
}

session::SessionPage sessions_for(const Services& services, const net::Caller& caller,
                                  store::SessionQuery query) {
  const access::Roles role = access::role_bit(caller.role);
  if (role == access::viewers && !caller.only_session.empty())
    return only(services.sessions, query, caller.only_session);
  if (role == access::trainees) {
    if (!query.trainee_id.empty() && query.trainee_id != caller.user_id) return {};
    query.trainee_id = caller.user_id;
  }
  // What is found by a person would tell who is behind a code.
  if (role != access::operators && role != access::trainees && !query.trainee_id.empty())
    query.outside_studies = true;
  query.without_studies = services.studies.rated_by(caller);
  return services.sessions.list(query);
}

net::Response list_sessions(const Services& services, const net::Request& request) {
  session::SessionPage page = sessions_for(services, request.caller, session_query(request));
  const study::Blinding blinding = services.studies.blinding(request.caller);
  json records = json::array();
  for (session::SessionRecord& record : page.sessions)
    records.push_back(to_json(blinding.seen(std::move(record))));
  json whole = {{"sessions", std::move(records)},
                {"next", or_null(page.next)},
                {"total", page.total},
                {"replays", visible_replays(services, request.caller)}};
  net::Response response = net::json_response(200, whole);
  if (!page.next.empty()) response.headers.emplace_back("Link", next_link(request, page.next));
  return response;
}

}  // namespace ream::api
