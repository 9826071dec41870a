#include <gtest/gtest.h>

#include <queue>

#include "fe/element_model.hpp"
#include "support/expect_error.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::fe::test {
namespace {

using ream::test::expect_error;

std::vector<uint16_t> codes_of(const ElementModel& model) {
  std::vector<uint16_t> scratch;
  const auto codes = model.codes.read(0, model.codes.size(), scratch);
  return {codes.begin(), codes.end()};
}

/// Flood fill, voxel by voxel: size of each component, and which each voxel belongs to.
std::vector<size_t> flood(const Vec3i& dims, const RandomGray& gray, std::vector<int>& of_voxel) {
  of_voxel.assign(static_cast<size_t>(dims.prod()), -1);
  const auto index = [&](const Vec3i& o) {
    return static_cast<size_t>(o.x() + dims.x() * (o.y() + dims.y() * o.z()));
  };
  std::vector<size_t> sizes;
  for (int i = 0; i < dims.prod(); ++i) {
    const Vec3i start(i % dims.x(), i / dims.x() % dims.y(), i / dims.x() / dims.y());
    if (gray(start.x(), start.y(), start.z()) < 0 || of_voxel[index(start)] >= 0) continue;
    std::queue<Vec3i> next({start});
    of_voxel[index(start)] = static_cast<int>(sizes.size());
    sizes.push_back(0);
    for (; !next.empty(); next.pop()) {
      ++sizes.back();
      for (int face = 0; face < 6; ++face) {
        Vec3i o = next.front();
        o[face / 2] += face % 2 == 0 ? 1 : -1;
        if (gray(o.x(), o.y(), o.z()) < 0 || of_voxel[index(o)] >= 0) continue;
        of_voxel[index(o)] = of_voxel[i];
        next.push(o);
      }
    }
  }
  return sizes;
}

TEST(Components, TheLargestIsKeptAsAFloodFillFindsIt) {
  uint64_t seed = 10;
  for (const Vec3i& dims : {Vec3i(9, 8, 7), Vec3i(70, 6, 5), Vec3i(20, 20, 1), Vec3i(3, 3, 40)})
    for (const double fill : {0.2, 0.3, 0.35, 0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << dims.transpose() << " fill " << fill << " seed " << seed);
      const RandomGray gray(dims, fill, seed++);
      std::vector<int> of_voxel;
      const std::vector<size_t> sizes = flood(dims, gray, of_voxel);
      const auto largest = std::max_element(sizes.begin(), sizes.end());
      ElementModel model = model_of(dims, gray);
      const uint64_t all = model.codes.size();
      MemoryBudget budget;
      const ComponentCount count = keep_largest_component(model, budget);
      EXPECT_EQ(count.components, sizes.size());
      EXPECT_EQ(model.codes.size(), *largest);
      EXPECT_EQ(count.removed_voxels, all - *largest);
      std::vector<uint16_t> expected;
      for (int i = 0; i < dims.prod(); ++i) {
        const Vec3i o(i % dims.x(), i / dims.x() % dims.y(), i / dims.x() / dims.y());
        const bool kept = of_voxel[static_cast<size_t>(i)] == largest - sizes.begin();
        EXPECT_EQ(model.mask.at(o.x(), o.y(), o.z()), kept);
        if (kept) expected.push_back(static_cast<uint16_t>(gray(o.x(), o.y(), o.z())));
      }
      EXPECT_EQ(codes_of(model), expected);
    }
}

TEST(Refine, SplitsEveryVoxelAndKeepsTheVolume) {
  for (const int factor : {2, 3, 5}) {
    const RandomGray gray({33, 5, 4}, 0.4, 77);
    const ElementModel coarse = model_of({33, 5, 4}, gray);
    MemoryBudget budget;
    const ElementModel fine = refined(model_of({33, 5, 4}, gray), factor, budget);
    const auto n = static_cast<uint64_t>(factor);
    EXPECT_EQ(fine.codes.size(), coarse.codes.size() * n * n * n);
    EXPECT_EQ(fine.mask.count(), fine.codes.size());
    EXPECT_DOUBLE_EQ(fine.spacing_mm.x() * factor, coarse.spacing_mm.x());
    for (int w = 0; w < 4 * factor; ++w)
      for (int v = 0; v < 5 * factor; ++v)
        for (int u = 0; u < 33 * factor; ++u)
          EXPECT_EQ(fine.mask.at(u, v, w), coarse.mask.at(u / factor, v / factor, w / factor));
  }
}

TEST(Refine, InterpolatesALinearFieldExactlyAwayFromTheBorder) {
  constexpr int factor = 4;
  const Vec3i dims(6, 5, 4);
  MemoryBudget budget;
  const ElementModel fine = refined(
      model_of(dims, [](int u, int v, int w) { return 1000 + 80 * u + 160 * v + 240 * w; }), factor, budget);
  const auto codes = codes_of(fine);
  size_t i = 0;
  for (int w = 0; w < dims.z() * factor; ++w)
    for (int v = 0; v < dims.y() * factor; ++v)
      for (int u = 0; u < dims.x() * factor; ++u, ++i) {
        const auto inner = [&](int at, int count) {
          return at >= factor / 2 && at < count * factor - factor / 2;
        };
        if (!inner(u, dims.x()) || !inner(v, dims.y()) || !inner(w, dims.z())) continue;
        const auto centre = [&](int at) { return (at + 0.5) / factor - 0.5; };
        EXPECT_EQ(codes[i], 1000 + 80 * centre(u) + 160 * centre(v) + 240 * centre(w));
      }
}

TEST(Refine, WhatIsNoBoneHasNoSay) {
  MemoryBudget budget;
  const ElementModel fine =
      refined(model_of({3, 3, 3}, [](int u, int v, int w) { return u == 1 && v == 1 && w == 1 ? 500 : -1; }),
              3, budget);
  EXPECT_EQ(codes_of(fine), std::vector<uint16_t>(27, 500));
}

CodeHistogram histogram(std::initializer_list<std::pair<int, uint64_t>> counts) {
  CodeHistogram result(code_count);
  for (const auto& [code, count] : counts) result[static_cast<size_t>(code)] = count;
  return result;
}

TEST(Materials, BinsHaveTheValueOfTheirCentreOrTheirMean) {
  MaterialRule rule;
  rule.law = linear_law(100.0, 10.0);
  rule.bin_width_mpa = 50.0;
  const CodeHistogram counts = histogram({{0, 1}, {4, 3}, {5, 2}, {100, 7}});  // E 100, 140, 150, 1100
  const Materials centres = make_materials(counts, {}, rule);
  ASSERT_EQ(centres.list.size(), 3u);
  EXPECT_DOUBLE_EQ(centres.list[0].modulus_mpa, 125.0);
  EXPECT_EQ(centres.list[0].elements, 4u);
  EXPECT_DOUBLE_EQ(centres.list[1].modulus_mpa, 175.0);
  EXPECT_DOUBLE_EQ(centres.list[2].modulus_mpa, 1125.0);
  EXPECT_EQ(centres.of_code[4], 0u);
  EXPECT_EQ(centres.of_code[100], 2u);
  rule.bin_value = BinValue::mean;
  EXPECT_DOUBLE_EQ(make_materials(counts, {}, rule).list[0].modulus_mpa, (100.0 + 3 * 140.0) / 4);
}

TEST(Materials, EqualModuliAreOneMaterialAndLawsAreWhatTheySay) {
  MaterialRule rule;
  rule.law = linear_law(500.0, 0.0);
  EXPECT_EQ(make_materials(histogram({{3, 1}, {9, 1}}), {}, rule).list.size(), 1u);
  EXPECT_DOUBLE_EQ(power_law(1.0, 2.0, 3.0).modulus_mpa(2.0), 17.0);
  EXPECT_NEAR(law_of_name("buechler-2002").law.modulus_mpa(1.8), 15000.0, 1e-9);
  EXPECT_NEAR(law_of_name("ciclope").law.modulus_mpa(250.0), 18000.0, 1e-9);
  EXPECT_NEAR(law_of_name("morgan-2003").law.modulus_mpa(1.0), 8920.0, 1e-9);
  expect_error(ErrorKind::usage, "morgan-2003", [] { law_of_name("hooke"); });
}

TEST(GrayScale, KeepsWholeNumbersAndShortDecimalsExactly) {
  const auto scale_of = [](const std::vector<float>& values) {
    voxel::GrayScaleFinder finder;
    for (const float v : values) finder.add(v);
    return finder.scale();
  };
  for (const auto& values : std::vector<std::vector<float>>{{0, 255, 17},
                                                            {-1024, 3071, 5},
                                                            {0.85f, 1.2345f, 0.0f},
                                                            {-0.5f, 0.25f},
                                                            {65535, 0},
                                                            {70000, 80000}}) {
    const voxel::GrayScale scale = scale_of(values);
    EXPECT_TRUE(scale.exact);
    for (const float v : values)
      EXPECT_FLOAT_EQ(static_cast<float>(scale.value(scale.code(static_cast<double>(v)))), v);
  }
  const voxel::GrayScale rough = scale_of({0.0f, 1e6f, 0.123456f});
  EXPECT_FALSE(rough.exact);
  EXPECT_NEAR(rough.value(rough.code(5e5)), 5e5, 1e6 / 65535);
}

}  // namespace
}  // namespace ream::fe::test
