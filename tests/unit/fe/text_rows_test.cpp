
#include <gtest/gtest.h>

#include <algorithm>

#include "fe/element_model.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::fe::test {
namespace {

using ream::test::expect_error;

class FeTextRows : public testing::Test {
 protected:
  ElementModel read(const std::string& text, MemoryBudget budget = {}) {
    return read_text_rows(folder_.write("rows.txt", text), budget);
  }
  void refuse(const std::string& mentioned, const std::string& text) {
    expect_error(ErrorKind::invalid_input, mentioned, [&] { read(text); });
  }
  static std::vector<uint16_t> codes_of(const ElementModel& model) {
    std::vector<uint16_t> scratch;
    const auto codes = model.codes.read(0, model.codes.size(), scratch);
    return {codes.begin(), codes.end()};
  }
  ream::test::TemporaryFolder folder_;
};

TEST_F(FeTextRows, GivesTheVoxelsWhateverTheirOrder) {
  const Vec3i dims(70, 20, 9);
  const RandomGray gray(dims, 0.3, 3);
  std::vector<std::string> lines;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u)
        if (gray(u, v, w) >= 0) {
          char line[100];
          std::snprintf(line, sizeof line, "%.4f\t%.5f, %.3f;%d\n", -3.0 + 0.0195 * u, 100.0 + 0.02 * v,
                        1.5 * w, gray(u, v, w));
          lines.emplace_back(line);
        }
  const ElementModel expected = model_of(dims, gray);
  for (const char* order : {"sorted", "turned around", "shuffled"}) {
    SCOPED_TRACE(order);
    std::mt19937_64 random(::ream::test::seed(9));
    if (*order == 't') std::reverse(lines.begin(), lines.end());
    if (*order == 's' && order[1] == 'h') std::shuffle(lines.begin(), lines.end(), random);
    std::string text = "# a comment\n\n";
    for (const std::string& line : lines) text += line;
    text.pop_back();  // the last line needs no break
    const ElementModel model = read(text);
    ASSERT_EQ(model.mask.dims(), dims);
    EXPECT_NEAR(model.spacing_mm.x(), 0.0195, 1e-6);
    EXPECT_NEAR(model.spacing_mm.z(), 1.5, 1e-9);
    EXPECT_NEAR(model.origin_mm.x(), -3.0 - 0.0195 / 2, 1e-4);
    for (int w = 0; w < dims.z(); ++w)
      for (int v = 0; v < dims.y(); ++v)
        for (int u = 0; u < dims.x(); ++u) ASSERT_EQ(model.mask.at(u, v, w), expected.mask.at(u, v, w));
    EXPECT_EQ(codes_of(model), codes_of(expected));
  }
}

TEST_F(FeTextRows, MissingPlanesLeaveGapsAndDecimalsStay) {
  const ElementModel model = read("0 0 0 0.85\n0.5 0 0 0.9\n1 0 0 1\n3 0 0 1.25\n0 0.5 0 1\n");
  EXPECT_EQ(model.mask.dims(), Vec3i(7, 2, 1));
  EXPECT_EQ(model.codes.size(), 5u);
  EXPECT_DOUBLE_EQ(model.spacing_mm.z(), 0.5);
  EXPECT_TRUE(model.gray.exact);
  EXPECT_NEAR(model.gray.value(codes_of(model)[0]), 0.85, 1e-12);
}

TEST_F(FeTextRows, IndicesGetTheirSizeFromAComment) {
  const ElementModel model = read("# spacing_mm 0.1 0.2 0.3\n3 5 7 10\n4 5 7 11\n3 6 7 12\n3 5 8 13\n");
  EXPECT_EQ(model.mask.dims(), Vec3i(2, 2, 2));
  EXPECT_DOUBLE_EQ(model.spacing_mm.y(), 0.2);
  EXPECT_NEAR(model.origin_mm.z(), 6.5 * 0.3, 1e-12);
  EXPECT_TRUE(model.remarks.empty());
  EXPECT_FALSE(read("3 5 7 10\n4 5 7 11\n3 6 7 12\n").remarks.empty());
}

std::string block(int edge) {
  std::string text;
  for (int i = 0; i < edge * edge * edge; ++i)
    text += std::to_string(i % edge) + " " + std::to_string(i / edge % edge) + " " +
            std::to_string(i / edge / edge) + " 9\n";
  return text;
}

TEST_F(FeTextRows, RefusesWhatIsNoGridAndNamesTheLine) {
  refuse("line 66", block(4) + "# here\n2.5 0 0 9\n");
  refuse("line 65: its x", block(4) + "-0.5 0 0 9\n");
  refuse("line 65: gives a voxel", block(4) + "1 2 3 9\n");
  refuse("line 65: gives a voxel", block(4) + "1.0 2.00 3 9\n");
  refuse("line 3: is not four", "0 0 0 1\n1 0 0 1\n2 0 zero 1\n");
  refuse("line 1: is not four", "0 0 0\n");
  refuse("line 1: is not four", "0 0 0 1 2\n");
  refuse("line 1: is not four", "0 0 0 nan\n");
  refuse("line 1: is not four", "inf 0 0 1\n");
  refuse("line 2", block(2).substr(0, 8) + std::string(5000, '1') + "\n");
  refuse("holds no rows", "# nothing\n\n");
  refuse("single voxel", "1.5 2 3 4\n");
  refuse("far off", "0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n5000 5000 5000 1\n");
  expect_error(ErrorKind::not_found, "nowhere", [&] {
    MemoryBudget budget;
    read_text_rows(folder_.path() / "nowhere.txt", budget);
  });
}

TEST_F(FeTextRows, ALongFileNamesTheFirstWrongLineWhoeverReadsIt) {
  std::string text = block(100);  // several blocks of the file
  const auto lines = static_cast<uint64_t>(std::count(text.begin(), text.end(), '\n'));
  refuse("line " + std::to_string(lines + 1) + ": gives", text + "50 50 50 1\n");
  for (const size_t at : {text.size() / 3, 2 * text.size() / 3}) text[text.find('\n', at) + 1] = 'x';
  const auto wrong = static_cast<uint64_t>(
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find('x')), '\n'));
  refuse("line " + std::to_string(wrong + 1) + ": is not", text);
}

TEST_F(FeTextRows, AThresholdTakesRowsAway) {
  ElementModel model = read("0 0 0 5\n1 0 0 6\n2 0 0 7\n");
  MemoryBudget budget;
  remove_below(model, 6.0, budget);
  EXPECT_EQ(codes_of(model), (std::vector<uint16_t>{6, 7}));
  EXPECT_FALSE(model.mask.at(0, 0, 0));
}

}  // namespace
}  // namespace ream::fe::test
