#pragma once
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "support/live_server.hpp"
#include "support/memory_in_use.hpp"

namespace ream::test {

/// The real server with a session that runs throughout. Whatever a test does to the server, the session must
/// not notice, and others must be served.
class HostileTest : public testing::Test {
 protected:
  static constexpr long memory_allowed_kib = 64 * 1024;  ///< more than before the test

  HostileTest() {
    rlimit files{};
    ::getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = files.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &files);
  }

  /// Starts the server with limits as `adjust` leaves them, and its sessions.
  void start(const std::function<void(net::Limits&)>& adjust = {}) {
    server_ = std::make_unique<LiveServer>([&](api::ServerOptions& options) {
      options.web_folder = server_files_.path() / "web";
      if (adjust) adjust(options.listen.limits);
    });
    write_file_atomically(server_->reaming().data() / "scripts/lean.json",
                          RecordedReaming::push("lambda.7", 600.0).dump());
    session_ = server_->run({{"case", "slab"}, {"device", "script"}, {"script", "lean"}});
    waiting_ = server_->post("", {{"case", "slab"}, {"device", "network"}}).at("id");
    LiveServer::until("the session to tick", [this] { return ticks() > 10; });
    memory_before_kib_ = memory_in_use_kib();
  }

  void TearDown() override {
    if (!server_) return;
    const HttpReply reply = http_request(port(), "GET", "/api/v1/sessions/" + session_);
    ASSERT_EQ(reply.status, 200) << "the server answers no more";
    // A loop that the machine has held up lets the session rest for a moment.
    EXPECT_NO_THROW(LiveServer::until("the session to run",
                                      [&] { return server_->get(session_).at("state") == "running"; }));
    const uint64_t now = ticks();
    EXPECT_NO_THROW(LiveServer::until("the session to tick on", [&] { return ticks() > now; }));
    EXPECT_TRUE(!memory_is_measurable() || most_memory_kib_ - memory_before_kib_ < memory_allowed_kib)
        << most_memory_kib_ - memory_before_kib_ << " KiB more";
  }

  uint16_t port() const { return server_->port(); }
  std::string stream_path() const { return "/api/v1/sessions/" + session_ + "/stream"; }
  std::string device_path() const { return "/api/v1/sessions/" + waiting_ + "/device"; }
  /// The session that has a device and is not started.
  const std::string& waiting() const { return waiting_; }
  const LiveServer& server() const { return *server_; }
  const std::string& session() const { return session_; }
  uint64_t ticks() const { return server_->get(session_).at("tick"); }

  /// To be called where a test believes that memory is at its peak.
  void look_at_memory() { most_memory_kib_ = std::max(most_memory_kib_, memory_in_use_kib()); }
  long memory_gained_kib() const { return memory_in_use_kib() - memory_before_kib_; }

  /// The server is there for everybody else, now.
  void expect_others_are_served() {
    look_at_memory();
    EXPECT_EQ(http_request(port(), "GET", "/healthz").status, 200);
  }

  const TemporaryFolder& server_files() const { return server_files_; }

 private:
  TemporaryFolder server_files_;
  std::unique_ptr<LiveServer> server_;
  std::string session_, waiting_;
  long memory_before_kib_ = 0, most_memory_kib_ = 0;
};

/// Header of a GET without its empty line.
inline std::string get_head(const std::string& path) {
  return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n";
}

}  // namespace ream::test
