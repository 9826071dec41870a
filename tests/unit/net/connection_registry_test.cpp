#include "net/connection_registry.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace ream::net {
namespace {

using Place = ConnectionRegistry::Place;
using Wait = Connection::Wait;

class Guest final : public Connection {
 public:
  Guest(std::string address, Wait wait) : Connection(std::move(address)) {
    set_wait(wait);
    // Two guests of the same moment could not be told apart.
    std::this_thread::sleep_for(std::chrono::microseconds(10));
  }
  void shut_down() override { asked_to_go = true; }
  void abandon() noexcept override {}
  bool asked_to_go = false;
};

class ConnectionRegistryTest : public testing::Test {
 protected:
  ConnectionRegistryTest() {
    limits.connections = 4;
    limits.connections_per_address = 3;
  }
  std::shared_ptr<Guest> guest(const std::string& address, Wait wait) {
    auto one = std::make_shared<Guest>(address, wait);
    EXPECT_TRUE(registry.add(one));
    return one;
  }
  Limits limits;
  ConnectionRegistry registry;
};

TEST_F(ConnectionRegistryTest, TheLongestWaitingGivesWayInAFullHouse) {
  const auto busy = guest("a", Wait::nothing), old = guest("a", Wait::request),
             young = guest("b", Wait::request);
  EXPECT_EQ(registry.make_room("c", limits), Place::free);
  const auto last = guest("b", Wait::request);
  EXPECT_FALSE(old->asked_to_go);
  EXPECT_EQ(registry.make_room("c", limits), Place::free);
  EXPECT_TRUE(old->asked_to_go);
  EXPECT_FALSE(busy->asked_to_go || young->asked_to_go || last->asked_to_go);
}

TEST_F(ConnectionRegistryTest, WhoSendsARequestStaysLongerThanWhoIsSilent) {
  const auto body = guest("a", Wait::body), head = guest("a", Wait::head), silent = guest("b", Wait::request);
  const auto busy = guest("b", Wait::nothing);
  for (const auto& next : {silent, head, body}) {
    EXPECT_FALSE(next->asked_to_go);
    EXPECT_EQ(registry.make_room("c", limits), Place::free);
    EXPECT_TRUE(next->asked_to_go);
    guest("c", Wait::nothing).reset();
    registry.add(busy);
  }
}

TEST_F(ConnectionRegistryTest, AFullAddressMakesRoomAmongItsOwn) {
  const auto other = guest("b", Wait::request);
  const auto first = guest("a", Wait::request), second = guest("a", Wait::request),
             third = guest("a", Wait::request);
  EXPECT_EQ(registry.make_room("a", limits), Place::free);
  EXPECT_TRUE(first->asked_to_go);
  EXPECT_FALSE(other->asked_to_go);
}

TEST_F(ConnectionRegistryTest, WhereAllAreBusyTheNewcomerIsToldAndThoseTellingAreBoundedToo) {
  std::vector<std::shared_ptr<Guest>> guests;
  for (const char* address : {"a", "a", "b", "b"}) guests.push_back(guest(address, Wait::nothing));
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(registry.make_room("c", limits), Place::busy);
    guests.push_back(std::make_shared<Guest>("c", Wait::nothing));
    registry.add(guests.back(), true);
  }
  EXPECT_EQ(registry.make_room("c", limits), Place::overfull);
  for (const auto& one : guests) registry.remove(one.get());
  EXPECT_EQ(registry.make_room("c", limits), Place::free);
}

TEST_F(ConnectionRegistryTest, ClosedTakesNobody) {
  registry.close();
  EXPECT_FALSE(registry.add(std::make_shared<Guest>("a", Wait::nothing)));
  EXPECT_EQ(registry.size(), 0u);
}

}  // namespace
}  // namespace ream::net
