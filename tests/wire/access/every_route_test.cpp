#include <optional>

#include "wire/access/personas.hpp"

namespace ream::test {
namespace {

using api::Right;
using api::RouteAccess;

/// One operation of openapi.yaml and its row in the table of rights.
struct Operation {
  std::string method, pattern;
  json described;
  Right right;
  bool changes() const { return method != "GET"; }
  bool is_websocket() const { return described.at("responses").contains("101"); }
};

enum class Answer { passes, who_are_you, not_you, no_such_thing };

class EveryRouteTest : public PersonaTest {
 protected:
  std::vector<Operation> operations() const {
    std::vector<Operation> all_of_them;
    for (const auto& [path, item] : contract.at("paths").items())
      for (const auto& [verb, operation] : item.items()) {
        if (verb == "parameters") continue;
        const Right* right = api::right_of(upper(verb), path);
        EXPECT_TRUE(right) << upper(verb) << ' ' << path << " has no row in the table of rights";
        if (right) all_of_them.push_back({upper(verb), path, operation, *right});
      }
    return all_of_them;
  }

  /// What the table and the persona come to. `may_see`: the persona may see the session that is asked for.
  Answer expected(const Operation& operation, const Persona& persona, bool may_see) const {
    if (operation.right.route_access == RouteAccess::anybody) return Answer::passes;
    if (persona.from_elsewhere && operation.changes()) return Answer::not_you;
    if (persona.role.empty())
      return operation.right.route_access == RouteAccess::monitoring && persona.shows_nothing
                 ? Answer::passes
                 : Answer::who_are_you;
    if (persona.without_csrf && operation.changes()) return Answer::not_you;
    if (operation.right.route_access == RouteAccess::monitoring)
      return Answer::passes;  // asked by this machine itself
    if (!(operation.right.who & access::role_bit(persona.role))) return Answer::not_you;
    const bool of_a_session = operation.pattern.starts_with(one);
    return of_a_session && !may_see ? Answer::no_such_thing : Answer::passes;
  }

  void expect_answer(const Operation& operation, const HttpReply& reply, Answer answer, bool right_input) {
    const json& responses = operation.described.at("responses");
    EXPECT_TRUE(responses.contains(std::to_string(reply.status))) << "it is not described: " << reply.status;
    EXPECT_LT(reply.status, 500) << reply.body;
    switch (answer) {
      case Answer::who_are_you:
        EXPECT_EQ(reply.status, 401) << reply.body;
        EXPECT_TRUE(reply.headers.contains("www-authenticate"));
        return;
      case Answer::not_you: EXPECT_EQ(reply.status, 403) << reply.body; return;
      case Answer::no_such_thing: EXPECT_EQ(reply.status, 404) << reply.body; return;
      case Answer::passes: break;
    }
    if (operation.right.route_access == RouteAccess::anybody) return;
    EXPECT_NE(reply.status, 401) << reply.body;
    EXPECT_FALSE(right_input && reply.status == 403) << reply.body;
    EXPECT_FALSE(right_input && operation.pattern.starts_with(one) && reply.status == 404) << reply.body;
  }

  /// Each persona, each with credentials of its own, asks with right and with wrong input.
  void ask_as_everybody(const Operation& operation) {
    for (const Persona& persona : personas())
      for (const bool right_input : {true, false}) {
        const Scene scene = scene_for(operation.pattern);
        const std::string path =
            right_input ? path_of(operation.pattern, scene) : wrong_path_of(operation.pattern);
        SCOPED_TRACE(persona.name + (right_input ? "" : ", wrong input") + ": " + operation.method + " " +
                     path);
        Sent sent = persona.credentials(scene);
        const std::string body = body_of(operation.described, right_input, sent);
        const Answer answer = expected(operation, persona, persona.sees_session || !right_input);
        expect_answer(operation, request(operation.method, path, sent, body), answer, right_input);
        if (operation.is_websocket() && right_input) expect_socket(operation, persona, scene, path, answer);
      }
  }

  /// The same by a real upgrade; a page says where it comes from.
  void expect_socket(const Operation& operation, const Persona& persona, const Scene& scene,
                     const std::string& path, Answer answer) {
    Sent sent = persona.credentials(scene);
    if (sent.contains("Cookie") && !sent.contains("Origin"))
      sent["Origin"] = "http://127.0.0.1:" + std::to_string(server->port());
    const RawWebSocket socket(server->port(), path, sent);
    const int status = socket.handshake().status;
    if (persona.from_elsewhere)
      EXPECT_EQ(status, 403) << operation.pattern;
    else if (answer == Answer::passes)
      EXPECT_TRUE(status == 101 || status == 409) << operation.pattern << ' ' << status;
    else
      expect_answer(operation, socket.handshake(), answer, true);
  }
};

TEST_F(EveryRouteTest, IsInTheTableOfRightsAndInTheContractAndServed) {
  std::set<std::string> described, served, entitled;
  for (const auto& [path, item] : contract.at("paths").items())
    for (const auto& [verb, operation] : item.items())
      if (verb != "parameters") described.insert(upper(verb) + " " + path);
  for (const auto& route : server->routes()) served.insert(route.method + " " + route.pattern);
  for (const Right& right : api::rights()) entitled.insert(right.method + " " + right.pattern);
  EXPECT_EQ(served, described);
  EXPECT_EQ(entitled, described);
}

TEST_F(EveryRouteTest, SaysInTheContractWhetherItAsksWhoItIs) {
  ASSERT_FALSE(contract.at("security").empty());
  for (const Operation& operation : operations()) {
    const bool open = operation.described.contains("security") && operation.described.at("security").empty();
    EXPECT_EQ(open, operation.right.route_access == RouteAccess::anybody)
        << operation.method << ' ' << operation.pattern;
    EXPECT_TRUE(open || operation.described.at("responses").contains("401"))
        << operation.method << ' ' << operation.pattern;
  }
}

TEST_F(EveryRouteTest, AnswersEveryRoleAsTheTableSays) {
  const auto all_of_them = operations();
  EXPECT_GT(all_of_them.size(), 60u);
  for (const Operation& operation : all_of_them) ask_as_everybody(operation);
}

TEST_F(EveryRouteTest, IsOpenToEverybodyWhileThereAreNoUsers) {
  options.database = nullptr;
  start();
  for (const Operation& operation : operations()) {
    SCOPED_TRACE(operation.method + " " + operation.pattern);
    const HttpReply reply = request(operation.method, wrong_path_of(operation.pattern));
    EXPECT_TRUE(operation.described.at("responses").contains(std::to_string(reply.status))) << reply.status;
    EXPECT_NE(reply.status, 401);
    EXPECT_NE(reply.status, 403);
  }
}

TEST_F(EveryRouteTest, NothingElseAnswers) {
  std::map<std::string, std::set<std::string>> methods_of;
  for (const Operation& operation : operations()) methods_of[operation.pattern].insert(operation.method);
  const Scene scene = scene_for(one);
  const Sent everything = page_of_id(operator_id);
  for (const auto& [pattern, own_methods] : methods_of) {
    const std::set<std::string> methods = methods_at(path_of(pattern, scene), methods_of);
    for (const char* method :
         {"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "PROPFIND", "MKCOL", "LINK"}) {
      if (methods.contains(method)) continue;
      const HttpReply reply = request(method, path_of(pattern, scene), everything);
      EXPECT_EQ(reply.status, 405) << method << ' ' << pattern;
      EXPECT_TRUE(reply.headers.contains("allow")) << method << ' ' << pattern;
    }
    for (const std::string& beside : {pattern + "/", pattern + "/more", "/" + pattern, pattern + "x"})
      EXPECT_TRUE(!methods_at(path_of(beside, scene), methods_of).empty() ||
                  request("GET", path_of(beside, scene), everything).status == 404)
          << beside;
  }
  for (const char* path :
       {"/api", "/api/", "/api/v1", "/api/v2/sessions", "/API/V1/SESSIONS", "/debug", "/admin",
        "/api/v1/users/", "/api/v1//users", "/.git/config", "/metrics/", "/server-status"})
    for (const char* method : {"GET", "POST"}) {
      const int status = request(method, path, everything).status;
      EXPECT_TRUE(status == 404 || status == 405) << method << ' ' << path << ' ' << status;
    }
}

}  // namespace
}  // namespace ream::test
