#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "api/server.hpp"
#include "support/fake_engine.hpp"
#include "support/raw_http.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bone.hpp"

namespace ream::test {

/// A server on a free port with fake sessions, two cases (one planned, one not), a broken one and a page.
class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    case_::Case planned;
    planned.id = "planned";
    planned.name = "A slab";
    planned.source = "made for this test";
    planned.bone = slab({8, 8, 8}, 0.5, 2.0, 1.0);
    planned.plan = slab_plan(planned.bone, 2.0);
    planned.plan->pilot_hole = case_::PilotHole{};
    planned.warnings = {"one slice is missing"};
    case_::save_case(planned, folder.path() / "cases" / "planned");
    case_::Case unplanned = planned;
    unplanned.id = "unplanned";
    unplanned.side = case_::Side::left;
    unplanned.plan.reset();
    case_::save_case(unplanned, folder.path() / "cases" / "unplanned");
    folder.write("cases/broken/case.json", "{\"id\": ");
    folder.write("web/index.html", "<html>page</html>");
    options.listen.port = 0;
    options.database = std::make_shared<store::Database>(database_url());
    options.cases_folder = folder.path() / "cases";
    options.web_folder = folder.path() / "web";
    options.engine = engine;
    options.sessions_folder = folder.path() / "sessions";
  }

  std::string database_url() const { return "sqlite:" + (folder.path() / "ream.db").string(); }
  void start() {
    server = std::make_unique<api::Server>(options);
    server->start();
  }
  HttpReply get(const std::string& path) { return http_request(server->port(), "GET", path); }
  HttpReply post(const std::string& path, const std::string& body = {}) {
    return http_request(server->port(), "POST", path, body);
  }
  std::string create(const std::string& script = "demo") {
    const HttpReply reply = post("/api/v1/sessions", R"({"case": "planned", "script": ")" + script + "\"}");
    EXPECT_EQ(reply.status, 201) << reply.body;
    return nlohmann::json::parse(reply.body).at("id");
  }

  TemporaryFolder folder;
  const std::shared_ptr<FakeEngine> engine = std::make_shared<FakeEngine>();
  api::ServerOptions options;
  std::unique_ptr<api::Server> server;
};

}  // namespace ream::test
