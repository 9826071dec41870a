#include "net/websocket_client.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "support/expect_error.hpp"

namespace ream::net {
namespace {

using namespace std::chrono_literals;

/// The process has no handle left; those that it has stay.
class NoHandles {
 public:
  NoHandles() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int next = ::dup(0);
    ::close(next);
    rlimit none = before_;
    none.rlim_cur = static_cast<rlim_t>(next);
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoHandles() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoHandles(const NoHandles&) = delete;
  NoHandles& operator=(const NoHandles&) = delete;

 private:
  rlimit before_{};
};

TEST(WebSocketClient, SaysInAnErrorOfOursThatNoHandleIsLeft) {
  WebSocketClient client;
  {
    const NoHandles none;
    test::expect_error(ErrorKind::unavailable, "127.0.0.1:9 cannot be reached",
                       [&] { client.connect("127.0.0.1", 9, "/", 100ms); });
  }
  EXPECT_FALSE(client.is_open());
  test::expect_error(ErrorKind::unavailable,
                     "127.0.0.1:", [&] { client.connect("127.0.0.1", 9, "/", 100ms); });
}

}  // namespace
}  // namespace ream::net
