#include "api/routes.hpp"

#include <gtest/gtest.h>

#include <set>
#include <type_traits>

#include "api/request_middleware.hpp"

namespace ream::api {
namespace {

using access::instructors;
using access::operators;
using access::role_bit;
using access::trainees;
using access::viewers;

bool is_open(const Route& route) { return route.access.kind == RouteAccess::Kind::anybody; }

TEST(Routes, HaveOneRowEach) {
  std::set<std::string> seen;
  for (const Route& route : routes())
    EXPECT_TRUE(seen.insert(route.method + " " + route.pattern).second) << route.method << route.pattern;
}

TEST(Routes, EveryRowBehindADoorNamesSomebody) {
  for (const Route& route : routes())
    EXPECT_EQ(route.access.roles == 0, is_open(route)) << route.method << ' ' << route.pattern;
}

TEST(Routes, OperatorsMayUseEveryRoute) {
  for (const Route& route : routes())
    EXPECT_TRUE(is_open(route) || route.access.roles & operators) << route.pattern;
}

TEST(Routes, AWiderRoleMayAllThatANarrowerOneMay) {
  for (const Route& route : routes()) {
    const access::Roles who = route.access.roles;
    EXPECT_FALSE(who & viewers && !(who & trainees)) << route.pattern;
    EXPECT_FALSE(who & trainees && !(who & instructors)) << route.pattern;
  }
}

TEST(Routes, ViewersChangeNothingButReplays) {
  for (const Route& route : routes())
    EXPECT_TRUE(!(route.access.roles & viewers) || route.method == "GET" ||
                route.pattern.ends_with("/replay") || route.pattern.ends_with("/playback"))
        << route.pattern;
}

TEST(Routes, WebSocketsAreGetAndChangeNothing) {
  for (const Route& route : routes()) {
    if (!std::holds_alternative<SocketHandler>(route.handler)) continue;
    EXPECT_EQ(route.method, "GET") << route.pattern;
    EXPECT_FALSE(route.change.kind) << route.pattern;
    EXPECT_TRUE(route.audit.kind == RouteAudit::Kind::reading ||
                route.audit.kind == RouteAudit::Kind::nothing)
        << route.pattern;
  }
}

static_assert(!std::is_default_constructible_v<RouteAudit>,
              "a row that says nothing of audit must not compile");

TEST(Routes, AuditsHaveAWordUnlessTheHandlerHasIt) {
  using Kind = RouteAudit::Kind;
  for (const Route& route : routes()) {
    const Kind kind = route.audit.kind;
    EXPECT_EQ(route.audit.action != nullptr, kind == Kind::change || kind == Kind::reading) << route.pattern;
    EXPECT_FALSE(kind == Kind::reading && route.method != "GET" && !route.pattern.ends_with("/replay") &&
                 !route.pattern.ends_with("/preview"))
        << route.pattern;
  }
}

TEST(Routes, DataOfPatientsAndTraineesIsAudited) {
  const std::set<std::string> told_by_lists{"/api/v1/cases",
                                            "/api/v1/sessions",
                                            "/api/v1/sessions/{id}",
                                            "/api/v1/sessions/{id}/metrics",
                                            "/api/v1/studies",
                                            "/api/v1/studies/{id}",
                                            "/api/v1/studies/{id}/codebook",
                                            "/api/v1/uploads",
                                            "/api/v1/uploads/{id}"};
  const auto below = [](const Route& route, const char* what) {
    return route.pattern.starts_with(std::string("/api/v1/") + what);
  };
  for (const Route& route : routes()) {
    const bool data = below(route, "cases") || below(route, "sessions") || below(route, "studies") ||
                      below(route, "uploads") || below(route, "scores") || below(route, "learning") ||
                      route.pattern.ends_with("/result");
    const bool tells = route.method == "GET" && data && !told_by_lists.contains(route.pattern);
    const bool changes_data = route.method == "DELETE" || (route.method == "PUT" && !below(route, "uploads"));
    EXPECT_FALSE((tells || changes_data) && route.audit.kind == RouteAudit::Kind::nothing)
        << route.method << ' ' << route.pattern;
  }
}

TEST(Routes, APreviewIsForThoseWhoMayWriteWhatIsPreviewedAndTellsNoChange) {
  const auto row = [](const std::string& method, const std::string& pattern) {
    for (const Route& route : routes())
      if (route.method == method && route.pattern == pattern) return route;
    throw std::logic_error("no route " + method + pattern);
  };
  const Route preview = row("POST", "/api/v1/sessions/{id}/score/preview");
  EXPECT_EQ(preview.access.roles, row("PUT", "/api/v1/rubrics/{id}").access.roles);
  EXPECT_EQ(preview.audit.kind, RouteAudit::Kind::reading);
  EXPECT_STREQ(preview.audit.action, row("GET", "/api/v1/sessions/{id}/score").audit.action);
  EXPECT_EQ(preview.change.kind, nullptr);
}

TEST(Routes, OnlyWhatReadsTellsNoChangeByItsRow) {
  for (const Route& route : routes())
    EXPECT_FALSE(route.change.kind && route.method == "GET") << route.pattern;
}

TEST(Routes, RequestsThatChangeSomethingAreTold) {
  net::Request request;
  request.parameters["id"] = "demo";
  net::Response response;
  const auto change = [&](const std::string& method, const std::string& pattern) -> std::optional<Change> {
    for (const Route& route : routes())
      if (route.method == method && route.pattern == pattern) return change_made(request, route, response);
    ADD_FAILURE() << "no route " << method << ' ' << pattern;
    return std::nullopt;
  };
  EXPECT_EQ(change("PUT", "/api/v1/cases/{id}/plan")->id, "demo");
  EXPECT_EQ(change("DELETE", "/api/v1/cases/{id}")->change, "deleted");
  EXPECT_FALSE(change("GET", "/api/v1/cases/{id}"));
  response.headers.emplace_back("Location", "/api/v1/sessions/rabcd2345");
  EXPECT_EQ(change("POST", "/api/v1/sessions/{id}/replay")->id, "rabcd2345");
  response.status = 409;
  EXPECT_FALSE(change("PUT", "/api/v1/cases/{id}/plan"));
}

TEST(Roles, AreKnownByTheirWordsOnly) {
  EXPECT_EQ(role_bit("operator"), operators);
  EXPECT_EQ(role_bit("instructor"), instructors);
  EXPECT_EQ(role_bit("trainee"), trainees);
  EXPECT_EQ(role_bit("viewer"), viewers);
  for (const char* word : {"", "Operator", "root", "operator "}) EXPECT_EQ(role_bit(word), 0u) << word;
}

}  // namespace
}  // namespace ream::api
