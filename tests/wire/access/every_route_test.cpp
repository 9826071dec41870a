#include <optional>

#include "wire/access/personas.hpp"

namespace ream::test {
namespace {

using api::Route;
using api::RouteAccess;

/// One operation of openapi.yaml and its row in the table of routes.
struct Operation {
  std::string method, pattern;
  json described;
  Route route;
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
        const std::string method = upper(verb), pattern = path;
        const auto row = std::find_if(api::routes().begin(), api::routes().end(), [&](const Route& route) {
          return route.method == method && route.pattern == pattern;
        });
        EXPECT_NE(row, api::routes().end()) << method << ' ' << pattern << " has no row in the table";
        if (row != api::routes().end()) all_of_them.push_back({method, pattern, operation, *row});
      }
    return all_of_them;
  }

  /// What the table and the persona come to. `may_see`: the persona may see the session that is asked for.
  Answer expected(const Operation& operation, const Persona& persona, bool may_see) const {
    if (operation.route.access.kind == RouteAccess::Kind::anybody) return Answer::passes;
    if (persona.from_elsewhere && operation.changes()) return Answer::not_you;
    if (persona.role.empty())
      return operation.route.access.kind == RouteAccess::Kind::monitoring && persona.shows_nothing
                 ? Answer::passes
                 : Answer::who_are_you;
    if (persona.without_csrf && operation.changes()) return Answer::not_you;
    if (operation.route.access.kind == RouteAccess::Kind::monitoring)
      return Answer::passes;  // asked by this machine itself
    if (!(operation.route.access.roles & access::role_bit(persona.role))) return Answer::not_you;
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
    if (operation.route.access.kind == RouteAccess::Kind::anybody) return;
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

TEST_F(EveryRouteTest, SaysInTheContractWhetherItAsksWhoItIs) {
  ASSERT_FALSE(contract.at("security").empty());
  for (const Operation& operation : operations()) {
    const bool open = operation.described.contains("security") && operation.described.at("security").empty();
    EXPECT_EQ(open, operation.route.access.kind == RouteAccess::Kind::anybody)
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

/// Lists and objects 100,000 deep, alone and as the value of every key that the body may have.
std::vector<std::string> deep_bodies(const json& body_schema) {
  const auto repeated = [](const std::string& text) {
    std::string all;
    for (int i = 0; i < 100'000; ++i) all += text;
    return all;
  };
  const std::string lists = repeated("[") + repeated("]"),
                    objects = repeated("{\"a\":") + "1" + repeated("}");
  std::vector<std::string> bodies = {lists, objects, repeated("[{\"a\":"), "{\"unknown\":" + lists + "}"};
  const json properties = body_schema.value("properties", json::object());
  for (const auto& [key, ignored] : properties.items()) bodies.push_back("{\"" + key + "\":" + lists + "}");
  return bodies;
}

TEST_F(EveryRouteTest, RefusesDeepBodiesOfEveryRole) {
  size_t asked = 0;
  for (const Operation& operation : operations()) {
    const json content =
        operation.described.value("/requestBody/content/application~1json"_json_pointer, json());
    if (content.is_null()) continue;
    json schema = content.at("schema");
    if (schema.contains("$ref"))
      schema = contract.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
    for (const std::string& user : {operator_id, instructor_id, tom_id}) {
      const Scene scene = scene_for(operation.pattern);
      for (const std::string& body : deep_bodies(schema)) {
        Sent sent = token_of(user);
        sent["Content-Type"] = "application/json";
        const HttpReply reply = request(operation.method, path_of(operation.pattern, scene), sent, body);
        EXPECT_TRUE(reply.status >= 400 && reply.status < 500)
            << operation.method << ' ' << operation.pattern << reply.status;
        EXPECT_LT(reply.body.size(), 1000u) << operation.pattern;
        ++asked;
      }
    }
  }
  EXPECT_GT(asked, 300u);
  EXPECT_EQ(request("GET", "/healthz").status, 200);
}

TEST_F(EveryRouteTest, IsOpenToEverybodyWhileThereAreNoUsers) {
  options.database = std::make_shared<store::Database>("sqlite:" + (folder.path() / "nobody.db").string());
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
