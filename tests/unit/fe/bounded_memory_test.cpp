#include <gtest/gtest.h>

#include "fe/element_model.hpp"
#include "support/expect_error.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::fe::test {
namespace {

using ream::test::expect_error;

/// A porous block of 110^3 whose gray values alone do not fit into what a small budget lends.
class BoundedMemory : public testing::Test {
 protected:
  static int gray(int u, int v, int w) { return (u * v + w) % 7 == 0 ? -1 : 100 + (u ^ v ^ w) % 100; }
  ream::test::TemporaryFolder folder_;
};

TEST_F(BoundedMemory, MeshesAreTheSameBytesHoweverLittleThereIs) {
  std::string texts[2];
  for (int i = 0; i < 2; ++i) {
    MemoryBudget budget = i == 0 ? MemoryBudget() : MemoryBudget(124'500'000, folder_.path());
    ElementModel model = model_of({110, 110, 110}, gray, 0.5, budget);
    EXPECT_EQ(model.codes.in_memory(), i == 0);
    MeshOptions options;
    options.check = true;
    options.rule.bin_width_mpa = 10.0;
    make_mesh(std::move(model), options, budget, folder_.path() / "mesh.inp");
    texts[i] = read_text_file(folder_.path() / "mesh.inp");
  }
  EXPECT_TRUE(texts[0] == texts[1]);
  EXPECT_EQ(folder_.entries().size(), 1u);
}

TEST_F(BoundedMemory, UpsamplesOutOfCoreToTheSameMesh) {
  std::string texts[2];
  for (int i = 0; i < 2; ++i) {
    MemoryBudget budget = i == 0 ? MemoryBudget() : MemoryBudget(126'000'000, folder_.path());
    MeshOptions options;
    options.upsample = 3;
    texts[i] = inp_of(model_of({50, 40, 40}, gray), options, budget);
  }
  EXPECT_TRUE(texts[0] == texts[1]);
}

TEST_F(BoundedMemory, WhatCannotLieOnTheDiskIsRefusedWithTheLimitItNeeds) {
  MemoryBudget budget(1, folder_.path());
  expect_error(ErrorKind::invalid_input, "--memory-mb", [&] {
    ElementModel model;
    fill_from_layers(
        model, {3000, 3000, 3000}, [](int, std::span<int32_t>) {}, budget);
  });
}

}  // namespace
}  // namespace ream::fe::test
