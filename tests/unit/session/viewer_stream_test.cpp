#include "session/live/viewer_stream.hpp"

#include <gtest/gtest.h>

#include "stream/fanout.hpp"

namespace ream::session {
namespace {

TEST(ViewerStream, PullsFromItsMailboxAndIsWokenForMore) {
  const auto fanout = std::make_shared<stream::Fanout>();
  const net::SharedBytes first = net::share("first"), second = net::share("second");
  fanout->publish_hello(first);
  int wakes = 0;
  const auto viewer = viewer_stream(fanout, 1);
  viewer->on_open([&wakes] { ++wakes; });
  EXPECT_EQ(viewer->next(), first);
  EXPECT_EQ(viewer->next(), std::nullopt);
  EXPECT_EQ(wakes, 0);
  fanout->publish_hello(second);
  EXPECT_EQ(wakes, 1);
  EXPECT_EQ(viewer->next(), second);
  EXPECT_EQ(viewer->next(), std::nullopt);
}

TEST(ViewerStream, ClosingEndsTheSubscription) {
  const auto fanout = std::make_shared<stream::Fanout>();
  int wakes = 0;
  const auto viewer = viewer_stream(fanout, 1);
  EXPECT_EQ(fanout->viewers(), 0u);
  viewer->on_open([&wakes] { ++wakes; });
  EXPECT_EQ(viewer->next(), std::nullopt);
  EXPECT_EQ(fanout->viewers(), 1u);
  viewer->on_close();
  EXPECT_EQ(fanout->viewers(), 0u);
  fanout->publish_hello(net::share("nobody is there"));
  EXPECT_EQ(wakes, 0);
}

}  // namespace
}  // namespace ream::session
