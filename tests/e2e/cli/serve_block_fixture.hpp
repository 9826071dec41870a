#pragma once
#include <signal.h>

#include <chrono>

#include "case/case.hpp"
#include "e2e/cli/serve_fixture.hpp"
#include "support/test_bone.hpp"

namespace ream::test {

/// A server on a small block of bone, which it can load in no time, and a script that presses on it for ten
/// minutes.
class ServeBlock : public Serve {
 protected:
  void SetUp() override {
    Serve::SetUp();
    case_::Case block;
    block.id = "block";
    block.name = "A block";
    block.source = "made for this test";
    block.bone = slab({72, 72, 48}, 0.5, 16.0, 1.2);
    block.plan = slab_plan(block.bone, 16.0);
    block.plan->reamer = "sphere 12,8";
    case_::save_case(block, folder() / "data/cases/block");
    write("data/scripts/press.json",
          R"({"device": "hand", "duration_s": 600, "stiffness_n_mm": 100, "vibration": {"source": "off"},
              "hand": {"start_mm": [0, 0, -0.3], "force_profile": [{"t_s": 0, "force_n": 40}]}})");
  }

  void until_ready() {
    until("it is ready", [&] { return http_request(port_, "GET", "/readyz").status == 200; });
  }

  /// On the C++ form, without real time; returns when it is ready.
  void serve_when_ready(const Words& more = {}) {
    Words words{"--backend", "cpu", "--realtime", "off"};
    words.insert(words.end(), more.begin(), more.end());
    serve(words);
    until_ready();
  }
  void end_server() {
    server_->send_signal(SIGTERM);
    EXPECT_EQ(server_->wait(std::chrono::seconds(20)), 0) << printed("server.err");
  }

  /// A session that presses on the block.
  std::string create() {
    return request(201, "POST", "/api/v1/sessions", R"({"case": "block", "script": "press"})").at("id");
  }
  static std::string path_of(const std::string& id) { return "/api/v1/sessions/" + id; }
  double duration_s(const std::string& id) {
    return request(200, "GET", path_of(id) + "/metrics").at("duration_s");
  }
};

}  // namespace ream::test
