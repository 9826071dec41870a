#include "reader/ct_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>

#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "unit/reader/changed_dicom.hpp"

namespace ream::reader {
using namespace ct;
namespace {

using test::TemporaryFolder;

int gray(int u, int v, int w) { return 100 * u + 10 * v - 7 * w - 300; }

/// Rows of a 5 x 4 x 3 grid at first + index * step, with so many digits.
std::vector<std::string> rows(const Vec3& first, const Vec3& step, int digits) {
  std::vector<std::string> lines;
  for (int u = 0; u < 5; ++u)
    for (int v = 0; v < 4; ++v)
      for (int w = 0; w < 3; ++w) {
        char text[128];
        std::snprintf(text, sizeof text, "%.*f %.*f %.*f %d", digits, first.x() + u * step.x(), digits,
                      first.y() + v * step.y(), digits, first.z() + w * step.z(), gray(u, v, w));
        lines.emplace_back(text);
      }
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end = "\n") {
  std::string text;
  for (const auto& line : lines) text += line + end;
  return text;
}

void expect_grid(const HuVolume& volume, const Vec3& first, const Vec3& step) {
  ASSERT_EQ(volume.dims, Vec3i(5, 4, 3));
  EXPECT_LT((volume.spacing_mm - step).norm(), 0.02 * step.norm());
  EXPECT_LT((volume.world_of_centre(Vec3i::Zero()) - first).norm(), 0.01);
  for (int u = 0; u < 5; ++u)
    for (int v = 0; v < 4; ++v)
      for (int w = 0; w < 3; ++w) EXPECT_EQ(volume.hu[volume.index(u, v, w)], gray(u, v, w));
}

TEST(TextRows, PositionsInAnyOrderAndManner) {
  const TemporaryFolder folder;
  const Vec3 first(-12.5, 3.25, 100.125), step(0.668, 0.5, 0.625);
  auto lines = rows(first, step, 6);
  expect_grid(read_text_rows(folder.write("a.txt", joined(lines))), first, step);
  std::shuffle(lines.begin(), lines.end(), std::mt19937(test::seed(11)));
  expect_grid(read_text_rows(folder.write("a.txt", joined(lines, "\r\n"))), first, step);
  for (auto& line : lines) std::replace(line.begin(), line.end(), ' ', ',');
  expect_grid(read_text_rows(folder.write("a.csv", "# from the scanner\n\n" + joined(lines))), first, step);
  std::string last_line_open = joined(lines);
  last_line_open.pop_back();
  expect_grid(read_text_rows(folder.write("a.txt", last_line_open)), first, step);
  expect_grid(read_text_rows(folder.write("a.txt", joined(rows(first, step, 2)))), first, step);
}

TEST(TextRows, IndicesAreVoxelsOfOneMillimetreUnlessSaid) {
  const TemporaryFolder folder;
  const std::string text = joined(rows(Vec3::Zero(), Vec3::Ones(), 0));
  const HuVolume plain = read_ct_files(folder.write("a.txt", text));
  expect_grid(plain, Vec3::Zero(), Vec3::Ones());
  EXPECT_TRUE(test::mentions(plain, "voxels of 1 mm"));
  const HuVolume sized = read_ct_files(folder.write("a.txt", "# spacing_mm 0.4 0.5 0.6\n" + text));
  expect_grid(sized, Vec3::Zero(), {0.4, 0.5, 0.6});
  EXPECT_FALSE(test::mentions(sized, "voxels of 1 mm"));
}

TEST(TextRows, MimicsExportIsACt) {
  const TemporaryFolder folder;
  const Vec3 first(18.3437, 128.3569, -21.0), step(0.390625, 0.390625, 1.0);
  std::string text;
  for (int w = 0; w < 3; ++w)
    for (int v = 0; v < 4; ++v)
      for (int u = 0; u < 5; ++u) {
        // As that program prints: a sign, three digits of exponent, commas, gray in a column of its own.
        const auto number = [](double value) {
          char digits[40];
          std::snprintf(digits, sizeof digits, "%+.8E", value);
          std::string words = digits;
          return words.insert(words.size() - 2, "0");
        };
        char gray_column[20];
        std::snprintf(gray_column, sizeof gray_column, "%+8d", gray(u, v, w));
        text += number(first.x() + u * step.x()) + ", " + number(first.y() + v * step.y()) + ", " +
                number(first.z() + w * step.z()) + "," + gray_column + "\r\n";
      }
  expect_grid(read_ct_files(folder.write("scan.txt", text)), first, step);
}

TEST(TextRows, FractionsOfGrayAreRoundedAndHugeOnesClamped) {
  const TemporaryFolder folder;
  const HuVolume volume = read_text_rows(folder.write(
      "a.txt", "0 0 0 1.5\n1 0 0 -2.5\n0 1 0 1e9\n1 1 0 -1e9\n0 0 1 0.4\n1 0 1 7e2\n0 1 1 -0.6\n1 1 1 3\n"));
  EXPECT_EQ(volume.hu, (std::vector<int16_t>{2, -2, 32767, -32768, 0, 700, -1, 3}));
}

TEST(TextRows, PiecesOfTheFileDoNotShow) {
  const TemporaryFolder folder;
  std::ostringstream text;
  HuVolume volume;
  volume.dims = {64, 50, 40};
  for (int w = 0; w < 40; ++w)
    for (int v = 0; v < 50; ++v)
      for (int u = 0; u < 64; ++u) {
        volume.hu.push_back(static_cast<int16_t>((u * 31 + v * 17 + w * 7) % 4000 - 1000));
        text << 0.25 * u << ' ' << 0.5 * v << '\t' << -3.0 + 1.25 * w << ' ' << volume.hu.back() << '\n';
      }
  double last = 0.0;
  const HuVolume back =
      read_text_rows(folder.write("a.txt", text.str()), [&](double share, std::string_view) {
        EXPECT_GE(share, last);
        last = share;
      });
  EXPECT_EQ(back.hu, volume.hu);
  EXPECT_GT(last, 0.5);
}

TEST(TextRows, ALongAxisInAnyOrder) {
  constexpr int side = 60000;
  std::vector<std::string> lines;
  for (int u = 0; u < side; ++u)
    for (int v = 0; v < 2; ++v)
      for (int w = 0; w < 2; ++w)
        lines.push_back(std::to_string(u) + " " + std::to_string(v) + " " + std::to_string(w) + " " +
                        std::to_string(u % 3000 + v));
  std::shuffle(lines.begin(), lines.end(), std::mt19937(test::seed(12)));
  const TemporaryFolder folder;
  const HuVolume volume = read_text_rows(folder.write("a.txt", joined(lines)));
  ASSERT_EQ(volume.dims, Vec3i(side, 2, 2));
  for (int u = 0; u < side; ++u) ASSERT_EQ(volume.hu[volume.index(u, 1, 1)], u % 3000 + 1);
}

TEST(TextRows, WhatIsNoGridIsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto good = rows({0.5, 0.5, 0.5}, {1, 1, 1}, 1);
  const auto refused = [&](std::vector<std::string> lines, const std::string& words) {
    test::expect_error(ErrorKind::invalid_input, words,
                       [&] { read_ct_files(folder.write("a.txt", joined(lines))); });
  };
  const auto with = [&](size_t line, const std::string& text) {
    auto lines = good;
    lines[line - 1] = text;
    return lines;
  };
  refused(with(7, "0.5 2.5 0.5"), "a.txt line 7: is not four finite numbers");
  refused(with(7, "0.5 2.5 0.5 nan"), "a.txt line 7: is not four finite numbers");
  refused(with(7, "0.5 2.5 inf 3"), "a.txt line 7: is not four finite numbers");
  refused(with(7, "0.5 2.5 0.5 3 4"), "a.txt line 7: is not four finite numbers");
  refused(with(7, "x y z gray"), "a.txt line 7: is not four finite numbers");
  refused(with(7, "0.5 2.83 0.5 3"), "a.txt line 7: its y lies on no regular grid");
  refused(with(7, good[8]), "a.txt line 9: gives a voxel that an earlier line gave already");
  auto hole = good;
  hole.erase(hole.begin() + 6);
  refused(hole, "a.txt: no row gives voxel 0 2 0");
  refused({good[0]}, "a.txt holds a single voxel");
  refused({"0 0 0 1", "1 0 0 1"}, "a.txt has a single y");
  refused({}, "a.txt holds no rows");
  refused({std::string(100000, '1')}, "a.txt line 1");
  refused(with(7, good[6] + "9999999.5 0.5 0.5 3"), "a.txt line 7");
  std::vector<std::string> cloud;
  for (int i = 0; i < 70000; ++i) cloud.push_back(std::to_string(0.1234567 * i * i) + " 0 0 1");
  refused(cloud, "more than 65,535 different x");
  std::vector<std::string> diagonal;
  for (int i = 0; i < 400; ++i)
    diagonal.push_back(std::to_string(i) + " " + std::to_string(i) + " " + std::to_string(i) + " 1");
  refused(diagonal, "a.txt has 400 rows for a grid of 64000000 voxels");
}

}  // namespace
}  // namespace ream::reader
