#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "core/file.hpp"
#include "ct/read/volume_answer.hpp"
#include "reader/gray_values.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::reader {
namespace {

using test::expect_error;

/// What rows gave: every voxel's code, or -1.
struct Given {
  GrayValues values;
  std::vector<uint16_t> listed;  ///< codes as they were written
  std::vector<int> codes;
  const Vec3i& dims() const { return values.place.dims; }
  int at(int u, int v, int w) const { return codes[values.place.index(u, v, w)]; }
  double value(size_t i) const { return values.gray.value(listed[i]); }
};

template <typename T>
std::vector<T> numbers_in(const std::filesystem::path& file) {
  const std::string bytes = read_text_file(file);
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
  return numbers;
}

class GivenRows : public testing::Test {
 protected:
  Given read(const std::string& text, uint64_t max_bytes = UINT64_MAX) {
    const auto given = folder_.path() / "given", values = folder_.path() / "values";
    std::filesystem::remove(given);
    std::filesystem::remove(values);
    Given result;
    result.values = write_row_values(folder_.write("rows.txt", text), given, values, max_bytes, no_progress);
    result.listed = numbers_in<uint16_t>(values);
    const auto words = numbers_in<uint64_t>(given);
    const Vec3i& dims = result.dims();
    size_t next = 0;
    for (int w = 0; w < dims.z(); ++w)
      for (int i = 0; i < dims.x() * dims.y(); ++i) {
        const size_t word =
            static_cast<size_t>(w) * ct::given_words_per_layer(dims) + static_cast<size_t>(i) / 64;
        result.codes.push_back((words.at(word) >> i % 64 & 1u) != 0 ? result.listed.at(next++) : -1);
      }
    EXPECT_EQ(next, result.listed.size());
    return result;
  }
  void refuse(const std::string& mentioned, const std::string& text) {
    expect_error(ErrorKind::invalid_input, mentioned, [&] { read(text); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(GivenRows, GivesTheVoxelsWhateverTheirOrder) {
  const Vec3i dims(70, 20, 9);
  std::mt19937_64 random(test::seed(3));
  std::vector<int> gray;
  for (int i = 0; i < dims.prod(); ++i)
    gray.push_back(random() % 10 < 3 ? static_cast<int>(100 + random() % 50) : -1);
  std::vector<std::string> lines;
  size_t next = 0;
  for (int w = 0; w < dims.z(); ++w)
    for (int v = 0; v < dims.y(); ++v)
      for (int u = 0; u < dims.x(); ++u)
        if (const int g = gray[next++]; g >= 0) {
          char line[100];
          std::snprintf(line, sizeof line, "%.4f\t%.5f, %.3f;%d\n", -3.0 + 0.0195 * u, 100.0 + 0.02 * v,
                        1.5 * w, g);
          lines.emplace_back(line);
        }
  for (const char* order : {"sorted", "turned around", "shuffled"}) {
    SCOPED_TRACE(order);
    if (*order == 't') std::reverse(lines.begin(), lines.end());
    if (*order == 's' && order[1] == 'h') std::shuffle(lines.begin(), lines.end(), random);
    std::string text = "# a comment\n\n";
    for (const std::string& line : lines) text += line;
    text.pop_back();  // the last line needs no break
    const Given given = read(text);
    ASSERT_EQ(given.dims(), dims);
    EXPECT_NEAR(given.values.place.spacing_mm.x(), 0.0195, 1e-6);
    EXPECT_NEAR(given.values.place.spacing_mm.z(), 1.5, 1e-9);
    EXPECT_NEAR(given.values.place.world_from_volume.translation_mm.x(), -3.0 - 0.0195 / 2, 1e-4);
    EXPECT_EQ(given.codes, gray);
  }
}

TEST_F(GivenRows, MissingPlanesLeaveGapsAndDecimalsStay) {
  const Given given = read("0 0 0 0.85\n0.5 0 0 0.9\n1 0 0 1\n3 0 0 1.25\n0 0.5 0 1\n");
  EXPECT_EQ(given.dims(), Vec3i(7, 2, 1));
  EXPECT_EQ(given.listed.size(), 5u);
  EXPECT_DOUBLE_EQ(given.values.place.spacing_mm.z(), 0.5);
  EXPECT_TRUE(given.values.gray.exact);
  EXPECT_NEAR(given.value(0), 0.85, 1e-12);
}

TEST_F(GivenRows, IndicesGetTheirSizeFromAComment) {
  const Given given = read("# spacing_mm 0.1 0.2 0.3\n3 5 7 10\n4 5 7 11\n3 6 7 12\n3 5 8 13\n");
  EXPECT_EQ(given.dims(), Vec3i(2, 2, 2));
  EXPECT_DOUBLE_EQ(given.values.place.spacing_mm.y(), 0.2);
  EXPECT_NEAR(given.values.place.world_from_volume.translation_mm.z(), 6.5 * 0.3, 1e-12);
  EXPECT_TRUE(given.values.place.warnings.empty());
  EXPECT_FALSE(read("3 5 7 10\n4 5 7 11\n3 6 7 12\n").values.place.warnings.empty());
}

TEST_F(GivenRows, MimicsWritesPlusesLongExponentsAndCommas) {
  const Given given = read(
      "+1.83437000E+001, +1.28356900E+002, -2.10000000E+001,    +327\r\n"
      "+1.87343300E+001, +1.28356900E+002, -2.10000000E+001,    +1024\r\n"
      "+1.83437000E+001, +1.28747530E+002, -2.10000000E+001,     -12\r\n"
      "+1.83437000E+001, +1.28356900E+002, -2.00000000E+001,      +0\r\n");
  EXPECT_EQ(given.dims(), Vec3i(2, 2, 2));
  EXPECT_NEAR(given.values.place.spacing_mm.x(), 0.39063, 1e-9);
  EXPECT_NEAR(given.values.place.world_of_centre({0, 0, 0}).y(), 128.3569, 1e-9);
  const auto value = [&](int u, int v, int w) { return given.values.gray.value(given.at(u, v, w)); };
  EXPECT_EQ(value(0, 0, 0), 327);
  EXPECT_EQ(value(1, 0, 0), 1024);
  EXPECT_EQ(value(0, 1, 0), -12);
  EXPECT_EQ(value(0, 0, 1), 0);
  EXPECT_EQ(given.at(1, 1, 1), -1);
  for (const char* wrong :
       {"+-1 0 0 5\n", "++1 0 0 5\n", "+ 1 0 5\n", "1 0 0 +\n", "1 0 0 +-5\n", "1 0 0 ++5.5\n"})
    refuse("line 1: is not four", wrong);
}

TEST_F(GivenRows, GiveTheSameHoweverLittleMemoryThereIs) {
  std::string text;
  for (int w = 0; w < 110; ++w)
    for (int v = 0; v < 110; ++v)
      for (int u = 0; u < 110; ++u)
        if ((u * v + w) % 7 != 0)
          text += std::to_string(u) + " " + std::to_string(v) + " " + std::to_string(w) + " " +
                  std::to_string(100 + (u ^ v ^ w) % 100) + "\n";
  const Given all = read(text), little = read(text, 1);
  EXPECT_TRUE(all.codes == little.codes);
  EXPECT_TRUE(all.listed == little.listed);
  EXPECT_EQ(all.at(3, 5, 7), 100 + (3 ^ 5 ^ 7));
}

std::string block(int edge) {
  std::string text;
  for (int i = 0; i < edge * edge * edge; ++i)
    text += std::to_string(i % edge) + " " + std::to_string(i / edge % edge) + " " +
            std::to_string(i / edge / edge) + " 9\n";
  return text;
}

TEST_F(GivenRows, RefusesWhatIsNoGridAndNamesTheLine) {
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
  refuse("at most 1e9", "0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n70000 0 0 1\n");
  refuse("far off", "0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n5000 5000 5000 1\n");
  const auto out = folder_.path() / "out";
  expect_error(ErrorKind::not_found, "nowhere",
               [&] { write_row_values(folder_.path() / "nowhere.txt", out, out, UINT64_MAX, no_progress); });
}

TEST_F(GivenRows, ALongFileNamesTheFirstWrongLineWhoeverReadsIt) {
  std::string text = block(100);  // several blocks of the file
  const auto lines = static_cast<uint64_t>(std::count(text.begin(), text.end(), '\n'));
  refuse("line " + std::to_string(lines + 1) + ": gives", text + "50 50 50 1\n");
  for (const size_t at : {text.size() / 3, 2 * text.size() / 3}) text[text.find('\n', at) + 1] = 'x';
  const auto wrong = static_cast<uint64_t>(
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find('x')), '\n'));
  refuse("line " + std::to_string(wrong + 1) + ": is not", text);
}

}  // namespace
}  // namespace ream::reader
