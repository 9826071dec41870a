#pragma once
#include <functional>

#include "access/secret.hpp"
#include "api/routes.hpp"
#include "wire/contract/access_fixture.hpp"

namespace ream::test {

/// What one request is about: made anew for each, so that none leaves traces for the next.
struct Scene {
  std::string session;  ///< of the trainee "tom"
  std::string replay;   ///< of that session
  std::string user;     ///< a trainee
};

/// Somebody who asks.
struct Persona {
  std::string name;
  std::string role;  ///< as the server should take them; empty: not known
  std::function<std::map<std::string, std::string>(const Scene&)> credentials;
  bool sees_session = true;  ///< tom's
  bool shows_nothing = false;
  bool without_csrf = false;
  bool from_elsewhere = false;  ///< a page of another site
};

/// A server with users: operator, instructor, and trainees tom and tess.
class PersonaTest : public AccessTest {
 protected:
  void SetUp() override {
    options.sessions.live = 100'000;
    options.sessions.of_trainee = 100'000;
    options.sessions.kept = 100'000;
    options.replays.open = 100'000;
    options.replays.of_caller = 100'000;
    options.data_folder = folder.path() / "data";
    start();
    operator_id = add_user("olga", access::Role::operator_);
    instructor_id = add_user("ina", access::Role::instructor);
    tom_id = add_user("tom", access::Role::trainee);
    tess_id = add_user("tess", access::Role::trainee);
    disabled_id = add_user("dora", access::Role::operator_);
    access::UserChange change;
    change.enabled = false;
    access_control().users.change(disabled_id, change);
  }

  /// What a page of that user sends, without the cost of a login.
  Sent page_of_id(const std::string& user_id) {
    return page_with(issue(access::CredentialKind::cookie, {user_id, {}, "", "", ""}));
  }
  static Sent page_with(const access::IssuedCredential& cookie) {
    return {{"Cookie", "ream_session=" + cookie.secret.reveal()},
            {"X-CSRF-Token", access::csrf_token_of(cookie.secret)}};
  }
  Sent guest_of(const std::string& session) {
    const auto link = issue(access::CredentialKind::link, {instructor_id, {}, "visit", session, ""});
    return page_with(issue(access::CredentialKind::cookie, {"", {}, "", session, "", link.row.id}));
  }
  Sent ended_token() {
    const std::string soon = utc_text(clock.function()() + std::chrono::seconds(1));
    const auto issued = issue(access::CredentialKind::token, {operator_id, {}, "", "", soon});
    clock.pass(std::chrono::seconds(2));
    return bearer(issued);
  }
  Sent unknown_token() { return bearer({{}, access::make_credential_secret().text}); }
  Sent revoked_token() {
    const auto issued = issue(access::CredentialKind::token, {operator_id, {}, "", "", ""});
    access_control().credentials.revoke(issued.row.id);
    return bearer(issued);
  }

  std::vector<Persona> personas();
  /// What requests of that pattern can be about.
  Scene scene_for(const std::string& pattern) {
    Scene scene;
    const Sent tom = token_of(tom_id);
    const auto made = [&](const std::string& path, const std::string& body) -> std::string {
      const HttpReply reply = request("POST", path, tom, body);
      EXPECT_EQ(reply.status, 201) << reply.body;
      return json::parse(reply.body).at("id");
    };
    if (pattern.starts_with(one)) scene.session = made(all, R"({"case": "planned", "script": "demo"})");
    for (const char* file : {"session.json", "recording.ream"})
      if (pattern.starts_with(one + "/"))
        folder.write("sessions/" + scene.session + "/" + file, R"({"case": "planned", "script": "demo"})");
    if (pattern.ends_with("/restore")) {
      EXPECT_EQ(request("POST", all + "/" + scene.session + "/stop", tom).status, 200);
      EXPECT_EQ(request("DELETE", all + "/" + scene.session, tom).status, 204);
    }
    if (pattern.ends_with("/playback")) {
      EXPECT_EQ(request("POST", all + "/" + scene.session + "/stop", tom).status, 200);
      scene.replay = made(all + "/" + scene.session + "/replay", "");
    }
    if (pattern.starts_with("/api/v1/users/{id}")) {
      scene.user = access::random_id();
      store::UserTable(*options.database, "operator")
          .add({scene.user, scene.user, "Somebody", "trainee", "2026-01-31T12:00:00Z", "", true});
    }
    return scene;
  }

  /// The pattern with things that exist, as far as there are any.
  std::string path_of(const std::string& pattern, const Scene& scene) const;
  /// With things that cannot exist.
  static std::string wrong_path_of(const std::string& pattern);
  /// A body and its type, by the operation's description.
  static std::string body_of(const json& operation, bool right_input, Sent& sent);
  using MethodsOf = std::map<std::string, std::set<std::string>>;  ///< by pattern
  /// All methods that a path answers to, by every pattern that it matches.
  static std::set<std::string> methods_at(const std::string& path, const MethodsOf& patterns);

  std::string operator_id, instructor_id, tom_id, tess_id, disabled_id;
};

inline std::vector<Persona> PersonaTest::personas() {
  const auto page = [this](const std::string& id) {
    return [this, id](const Scene&) { return page_of_id(id); };
  };
  const auto token = [this](const std::string& id, std::optional<access::Role> limit = std::nullopt) {
    return [this, id, limit](const Scene&) { return token_of(id, limit); };
  };
  std::vector<Persona> all_of_them = {
      {"anonymous", "", [](const Scene&) { return Sent{}; }},
      {"unknown token", "",
       [](const Scene&) {
         return Sent{{"Authorization", "Bearer ream_nothing"}};
       }},
      {"token of nobody", "", [this](const Scene&) { return ended_token(); }},
      {"revoked token", "", [this](const Scene&) { return revoked_token(); }},
      {"disabled user", "", [this](const Scene&) { return token_of(disabled_id); }},
      {"not a bearer", "",
       [](const Scene&) {
         return Sent{{"Authorization", "Basic b2xnYTpvbGdh"}};
       }},
      {"operator", "operator", page(operator_id)},
      {"operator's token", "operator", token(operator_id)},
      {"instructor", "instructor", page(instructor_id)},
      {"instructor's token to watch", "viewer", token(instructor_id, access::Role::viewer)},
      {"trainee, own", "trainee", page(tom_id)},
      {"trainee's token, own", "trainee", token(tom_id)},
      {"trainee, another's", "trainee", page(tess_id)},
      {"link to this session", "viewer", [this](const Scene& scene) { return guest_of(scene.session); }},
      {"link to another session", "viewer", [this](const Scene&) { return guest_of("another"); }},
      {"link to all sessions", "viewer", [this](const Scene&) { return guest_of(""); }},
      {"cookie without its token", "operator",
       [this](const Scene&) { return without(page_of_id(operator_id), "X-CSRF-Token"); }},
      {"cookie with another's token", "operator",
       [this](const Scene&) {
         return with(page_of_id(operator_id), "X-CSRF-Token", page_of_id(operator_id).at("X-CSRF-Token"));
       }},
      {"page of another site", "operator",
       [this](const Scene&) { return with(page_of_id(operator_id), "Origin", "https://elsewhere.example"); }},
  };
  for (Persona& persona : all_of_them) {
    persona.shows_nothing = persona.name == "anonymous";
    persona.without_csrf = persona.name.starts_with("cookie with");
    persona.from_elsewhere = persona.name == "page of another site";
    persona.sees_session = persona.name.find("another") == std::string::npos || persona.role == "operator";
  }
  return all_of_them;
}

inline std::string PersonaTest::path_of(const std::string& pattern, const Scene& scene) const {
  std::string path = pattern;
  const auto fill = [&path](const std::string& parameter, const std::string& value) {
    if (const size_t at = path.find(parameter); at != std::string::npos)
      path.replace(at, parameter.size(), value);
  };
  fill("{id}", !scene.replay.empty()                       ? scene.replay
               : !scene.session.empty()                    ? scene.session
               : !scene.user.empty()                       ? scene.user
               : pattern.starts_with("/api/v1/cases/{id}") ? "unplanned"
                                                           : "nothing");
  fill("{axis}", "u");
  fill("{index}", "0");
  for (size_t at = path.find('{'); at != std::string::npos; at = path.find('{'))
    path.replace(at, path.find('}', at) + 1 - at, "nothing");
  return path;
}

inline std::string PersonaTest::wrong_path_of(const std::string& pattern) {
  std::string path = pattern;
  for (size_t at = path.find('{'); at != std::string::npos; at = path.find('{'))
    path.replace(at, path.find('}', at) + 1 - at, "no-such-thing");
  return path;
}

inline std::string PersonaTest::body_of(const json& operation, bool right_input, Sent& sent) {
  const json body = operation.value("requestBody", json::object());
  if (body.empty()) return {};
  const std::string type = body.at("content").begin().key();
  sent["Content-Type"] = type;
  if (type != "application/json") return right_input ? "abc" : "";
  return right_input ? "{}" : "{\"broken\": ";
}

inline std::set<std::string> PersonaTest::methods_at(const std::string& path, const MethodsOf& patterns) {
  const auto segments = [](const std::string& text) {
    std::vector<std::string> parts;
    for (size_t begin = 1; begin <= text.size();) {
      const size_t end = std::min(text.find('/', begin), text.size());
      parts.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
    return parts;
  };
  const auto fits = [](const std::string& part, const std::string& given) {
    return part.starts_with("{") ? !given.empty() : part == given;
  };
  const auto asked = segments(path);
  std::set<std::string> methods;
  for (const auto& [pattern, of_pattern] : patterns) {
    const auto parts = segments(pattern);
    if (parts.size() == asked.size() && std::equal(parts.begin(), parts.end(), asked.begin(), fits))
      methods.insert(of_pattern.begin(), of_pattern.end());
  }
  if (methods.contains("GET")) methods.insert("HEAD");
  return methods;
}

}  // namespace ream::test
