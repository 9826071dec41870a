#pragma once
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/server.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "session/service/simulation_engine.hpp"
#include "support/raw_http.hpp"
#include "support/recorded_reaming.hpp"
#include "support/wait_until.hpp"

namespace ream::test {

/// The real server on a free port, with the case `slab` and the loop on ordinary threads. The clock that
/// watches the loops stands still: a machine that is busy elsewhere ends no session (sim/loop_guard_test.cpp
/// tests the guard).
class LiveServer {
 public:
  explicit LiveServer(const std::function<void(api::ServerOptions&)>& adjust = {}) {
    session::SessionContext context{reaming_.data(), 1, "cpu", sim::Realtime::off};
    context.guard_now_ns = [] { return int64_t{1}; };
    std::filesystem::create_directories(sessions_folder(context.data));
    std::filesystem::create_directories(context.data / "scripts");
    api::ServerOptions options;
    options.listen.port = 0;
    options.cases_folder = cases_folder(context.data);
    options.sessions_folder = sessions_folder(context.data);
    options.sessions.live = 16;
    options.engine = std::make_shared<session::SimulationEngine>(context);
    options.database = std::make_shared<store::Database>("sqlite:" + (reaming_.data() / "ream.db").string());
    if (adjust) adjust(options);
    server_ = std::make_unique<api::Server>(std::move(options));
    server_->start();
    until("the server to be ready", [this] { return http_request(port(), "GET", "/readyz").status == 200; });
  }

  uint16_t port() const { return server_->port(); }
  std::filesystem::path folder(const std::string& id) const { return sessions_folder(reaming_.data()) / id; }
  const RecordedReaming& reaming() const { return reaming_; }

  nlohmann::json post(const std::string& path, const nlohmann::json& body = nullptr) const {
    const HttpReply reply =
        http_request(port(), "POST", "/api/v1/sessions" + path, body.is_null() ? std::string() : body.dump());
    if (reply.status >= 300) throw std::runtime_error(path + ": " + reply.body);
    return nlohmann::json::parse(reply.body);
  }
  nlohmann::json get(const std::string& id) const {
    return nlohmann::json::parse(http_request(port(), "GET", "/api/v1/sessions/" + id).body);
  }
  /// Id of a session that runs.
  std::string run(const nlohmann::json& wanted) const {
    const std::string id = post("", wanted).at("id");
    post("/" + id + "/start");
    return id;
  }

  template <typename Condition>
  static void until(const std::string& what, Condition condition) {
    wait_until(what, condition);
  }

 private:
  RecordedReaming reaming_;
  std::unique_ptr<api::Server> server_;
};

}  // namespace ream::test
