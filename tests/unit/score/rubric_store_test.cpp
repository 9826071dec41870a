#include "score/rubric_store.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::score {
namespace {

using test::expect_error;

class RubricStoreTest : public testing::Test {
 protected:
  Rubric rubric(double weight) const {
    Rubric r;
    r.name = "First year";
    r.criteria.push_back({"duration_s", Ramp{600.0, 60.0}, std::nullopt, weight, false});
    return r;
  }

  test::TemporaryFolder folder_;
  RubricStore store_{folder_.path() / "rubrics"};
};

TEST_F(RubricStoreTest, StandardIsAlwaysThere) {
  EXPECT_EQ(store_.ids(), std::vector<std::string>{"standard"});
  EXPECT_EQ(rubric_hash(store_.get("standard")), rubric_hash(standard_rubric()));
}

TEST_F(RubricStoreTest, AChangeMakesANewVersionAndOldOnesAreKept) {
  EXPECT_EQ(store_.save("first-year", rubric(1.0)).version, 1);
  EXPECT_EQ(store_.save("first-year", rubric(2.0)).version, 2);
  EXPECT_EQ(store_.save("first-year", rubric(2.0)).version, 2) << "nothing changed";
  EXPECT_EQ(store_.save("first-year", rubric(1.0)).version, 3);
  EXPECT_EQ(store_.versions("first-year"), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(store_.get("first-year").version, 3);
  EXPECT_EQ(store_.get("first-year", 2).criteria[0].weight, 2.0);
  EXPECT_EQ(store_.ids(), (std::vector<std::string>{"first-year", "standard"}));
}

TEST_F(RubricStoreTest, StandardMayBeChangedLikeAnyOther) {
  Rubric mine = standard_rubric();
  EXPECT_EQ(store_.save("standard", mine).version, 1) << "nothing changed";
  mine.pass_points = 80.0;
  EXPECT_EQ(store_.save("standard", mine).version, 2);
  EXPECT_EQ(store_.get("standard").pass_points, 80.0);
  EXPECT_EQ(store_.get("standard", 1).pass_points, standard_rubric().pass_points);
}

TEST_F(RubricStoreTest, IsFoundByIdVersionOrFile) {
  store_.save("mine", rubric(1.0));
  store_.save("mine", rubric(2.0));
  EXPECT_EQ(find_rubric("mine", store_).version, 2);
  EXPECT_EQ(find_rubric("mine@1", store_).version, 1);
  EXPECT_EQ(find_rubric((folder_.path() / "rubrics/mine/1.json").string(), store_).version, 1);
  expect_error(ErrorKind::not_found, "no version 7", [&] { find_rubric("mine@7", store_); });
  expect_error(ErrorKind::invalid_input, "mine@x", [&] { find_rubric("mine@x", store_); });
  expect_error(ErrorKind::not_found, "nowhere.json", [&] { find_rubric("nowhere.json", store_); });
  expect_error(ErrorKind::not_found, "theirs", [&] { find_rubric("theirs", store_); });
}

TEST_F(RubricStoreTest, NothingIsKeptThatCouldNotBeUsed) {
  expect_error(ErrorKind::invalid_input, "../x", [&] { store_.save("../x", rubric(1.0)); });
  expect_error(ErrorKind::invalid_input, "weight", [&] { store_.save("mine", rubric(-1.0)); });
  expect_error(ErrorKind::not_found, "mine", [&] { store_.get("mine"); });
}

TEST_F(RubricStoreTest, OtherFilesAreNoVersions) {
  store_.save("mine", rubric(1.0));
  for (const char* name : {"0.json", "02x.json", "2.json.123.new", "notes.txt"})
    std::ofstream(folder_.path() / "rubrics/mine" / name) << "{}";
  EXPECT_EQ(store_.versions("mine"), std::vector<int>{1});
}

TEST_F(RubricStoreTest, ManyAtOnceLoseNoVersion) {
  constexpr int writers = 8;
  std::vector<std::thread> threads;
  for (int i = 0; i < writers; ++i) threads.emplace_back([&, i] { store_.save("mine", rubric(1.0 + i)); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(store_.versions("mine").size(), static_cast<size_t>(writers));
  double weights = 0.0;
  for (const int version : store_.versions("mine")) weights += store_.get("mine", version).criteria[0].weight;
  EXPECT_DOUBLE_EQ(weights, 36.0);
}

}  // namespace
}  // namespace ream::score
