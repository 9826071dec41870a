#include "api/readiness.hpp"

#include <gtest/gtest.h>

#include <future>

#include "support/expect_error.hpp"
#include "support/fake_engine.hpp"

namespace ream::api {
namespace {

TEST(Readiness, NothingToPrepareIsReady) {
  test::FakeEngine engine;
  const Readiness readiness(engine, false);
  EXPECT_NO_THROW(readiness.require_ready());
}

TEST(Readiness, IsNotReadyWhilePreparing) {
  std::promise<void> release;
  test::FakeEngine engine;
  engine.demo_case = [&] { release.get_future().wait(); };
  const Readiness readiness(engine, true);
  test::expect_error(ErrorKind::unavailable, "preparing", [&] { readiness.require_ready(); });
  test::expect_error(ErrorKind::unavailable, "preparing", [&] { readiness.require_prepared(); });
  release.set_value();
}

TEST(Readiness, FailureIsToldButDoesNotStandInTheWayOfOtherThings) {
  test::FakeEngine engine;
  engine.demo_case = [] { throw Error(ErrorKind::io, "disk full"); };
  const Readiness readiness(engine, true);
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
