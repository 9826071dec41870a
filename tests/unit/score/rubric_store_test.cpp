#include "score/rubric_store.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "core/file.hpp"
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
  const int shipped = mine.version;
  EXPECT_EQ(store_.save("standard", mine).version, shipped) << "nothing changed";
  mine.pass_points = 80.0;
  EXPECT_EQ(store_.save("standard", mine).version, shipped + 1);
  EXPECT_EQ(store_.get("standard").pass_points, 80.0);
  EXPECT_EQ(store_.get("standard", shipped).pass_points, standard_rubric().pass_points);
}

TEST_F(RubricStoreTest, EveryStandardThatWasEverShippedCanBeHadAgain) {
  for (size_t i = 0; i < standard_rubrics().size(); ++i) {
    const auto version = static_cast<int>(i) + 1;
    EXPECT_EQ(standard_rubrics()[i].version, version);
    EXPECT_EQ(rubric_hash(store_.get("standard", version)), rubric_hash(standard_rubrics()[i]));
  }
  EXPECT_EQ(rubric_hash(store_.get("standard")), rubric_hash(standard_rubric()));
  EXPECT_EQ(rubric_hash(store_.get("standard", 1)), 3866880376543536442u)
      << "sessions were judged by it: it never changes";
}

TEST_F(RubricStoreTest, AStandardOfTheHouseStandsBeforeTheShippedOneOfItsNumber) {
  Rubric house = rubric(3.0);
  house.version = 2;
  std::filesystem::create_directories(folder_.path() / "rubrics/standard");
  write_json_file(folder_.path() / "rubrics/standard/2.json", rubric_json(house));
  EXPECT_EQ(store_.get("standard", 2).name, house.name);
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
