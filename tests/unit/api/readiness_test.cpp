#include "api/readiness.hpp"

#include <gtest/gtest.h>

#include <future>

#include "support/expect_error.hpp"

namespace ream::api {
namespace {

TEST(Readiness, NothingToPrepareIsReady) {
  const Readiness readiness({});
  EXPECT_NO_THROW(readiness.require_ready());
}

TEST(Readiness, IsNotReadyWhilePreparing) {
  std::promise<void> release;
  Readiness readiness([&] { release.get_future().wait(); });
  test::expect_error(ErrorKind::unavailable, "preparing", [&] { readiness.require_ready(); });
  test::expect_error(ErrorKind::unavailable, "preparing", [&] { readiness.require_prepared(); });
  release.set_value();
}

TEST(Readiness, FailureIsToldButDoesNotStandInTheWayOfOtherThings) {
  Readiness readiness([] { throw Error(ErrorKind::io, "disk full"); });
  const auto prepared = [&] {
    try {
      readiness.require_prepared();
      return true;
    } catch (const Error&) {
      return false;
    }
  };
  while (!prepared()) std::this_thread::yield();
  test::expect_error(ErrorKind::unavailable, "disk full", [&] { readiness.require_ready(); });
}

}  // namespace
}  // namespace ream::api
