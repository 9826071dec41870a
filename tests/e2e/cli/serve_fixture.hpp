#pragma once
#include <functional>
#include <thread>

#include "e2e/cli/command_line.hpp"
#include "support/raw_http.hpp"

namespace ream::test {

/// A server in a process of its own, on any free port.
class Serve : public CommandLine {
 protected:
  using Sent = std::map<std::string, std::string>;

  void SetUp() override { write("web/index.html", "<!doctype html><title>page</title>"); }

  /// Returns when it says where it is.
  void serve(const Words& more = {}) {
    if (takes_demo_case_ && !std::filesystem::exists(folder() / "data/cases/demo")) take_demo_case();
    Words command = {"serve", "--port", "0", "--web", "web", "--json"};
    command.insert(command.end(), more.begin(), more.end());
    server_ = start(command, "server");
    hear_where_it_is();
  }

  /// Of a server that was started under that name.
  void hear_where_it_is() {
    until("the server says where it is", [&] { return printed("server.out").ends_with('\n'); });
    said_ = nlohmann::json::parse(printed("server.out"));
    const std::string url = said_.at("url");
    port_ = static_cast<uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  }

  void until(const std::string& what, const std::function<bool()>& reached) {
    for (int i = 0; i < 6000 && !server_->ended(); ++i) {
      if (reached()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    throw std::runtime_error("waited in vain until " + what + "\n" + printed("server.err"));
  }

  nlohmann::json request(int status, const std::string& method, const std::string& target,
                         const std::string& body = {}, const Sent& sent = {}) {
    const HttpReply reply = http_request(port_, method, target, body, sent);
    EXPECT_EQ(reply.status, status) << method << ' ' << target << '\n' << reply.body;
    return reply.body.empty() ? nlohmann::json() : nlohmann::json::parse(reply.body);
  }

  bool takes_demo_case_ = true;  ///< false where the server has to make it
  std::unique_ptr<ChildProcess> server_;
  nlohmann::json said_;  ///< at its start
  uint16_t port_ = 0;
};

}  // namespace ream::test
