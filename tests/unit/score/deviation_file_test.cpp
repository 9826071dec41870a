#include "score/deviation.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"

namespace ream::score {
namespace {

TEST(DeviationFile, HoldsEachFieldWhereItSays) {
  const test::TemporaryFolder folder;
  const DeviationFields fields{{0, 5, -128, 127}, {-1, -2, -3, -4}, {8, 9, 10, 127}};
  write_deviation(folder.path() / "deviation.json", "reamed.ply", 4, fields);
  const nlohmann::json told = read_json_file(folder.path() / "deviation.json");
  const nlohmann::json schema = read_json_file(test::source_folder() + "/proto/deviation.schema.json");
  EXPECT_EQ(test::schema_faults(schema, told), std::vector<std::string>{});
  EXPECT_EQ(told["mesh"], "reamed.ply");
  EXPECT_EQ(told["step_mm"], 0.03125);
  const auto bytes = read_binary_file(folder.path() / told["file"].get<std::string>());
  ASSERT_EQ(bytes.size(), 12u);
  EXPECT_EQ(static_cast<int8_t>(bytes[told["fields"][0]["offset"].get<size_t>() + 1]), 5);
  EXPECT_EQ(static_cast<int8_t>(bytes[told["fields"][0]["offset"].get<size_t>() + 2]), deviation_unknown);
  EXPECT_EQ(static_cast<int8_t>(bytes[told["fields"][1]["offset"].get<size_t>() + 3]), -4);
  EXPECT_EQ(told["revision"], deviation_revision);
  EXPECT_EQ(told["fields"][1]["step_mm"], 0.03125);
  EXPECT_EQ(told["fields"][2]["name"], "wall");
  EXPECT_EQ(told["fields"][2]["step_mm"], 0.25);
  EXPECT_EQ(static_cast<int8_t>(bytes[told["fields"][2]["offset"].get<size_t>()]), 8);
}

TEST(DeviationFile, LeavesOutWhatThereIsNothingToCompareWith) {
  const test::TemporaryFolder folder;
  write_deviation(folder.path() / "deviation.json", "reamed.ply", 2, {{1, 2}, {}, {}});
  const nlohmann::json told = read_json_file(folder.path() / "deviation.json");
  ASSERT_EQ(told["fields"].size(), 1u);
  EXPECT_EQ(told["fields"][0]["name"], "plan");
  EXPECT_EQ(read_binary_file(folder.path() / "deviation.bin").size(), 2u);
}

}  // namespace
}  // namespace ream::score
