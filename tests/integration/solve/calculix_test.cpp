#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "core/clock.hpp"
#include "ct/read/gray_volume.hpp"
#include "solve/bone_compression.hpp"
#include "support/seed.hpp"
#include "support/shared_data.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::solve::test {
namespace {

constexpr double allowed_difference = 1e-3;

#define REAM_SKIP_WITHOUT_CCX() \
  if (std::system("command -v ccx >/dev/null 2>&1") != 0) GTEST_SKIP() << "CalculiX (ccx) is not installed"

/// A test of compression, by ream solve and by CalculiX, whose direct solution of the same elements is the
/// judge.
class AgainstCalculix : public testing::Test {
 protected:
  void compare(const std::function<fe::ElementModel()>& model, const CompressionRequest& request) {
    MemoryBudget budget;
    const CompressionResult ours = compress(model(), request, budget);
    ASSERT_TRUE(ours.converged) << ours.relative_residual;
    const double theirs = force_of_calculix(model(), request);
    EXPECT_NEAR(ours.force_n / theirs, 1.0, allowed_difference)
        << ours.elements << " elements, axis " << request.compression.axis;
    greatest_ = std::max(greatest_, std::abs(ours.force_n / theirs - 1.0));
    ++compared_;
  }

  /// Force on the platen that stands, N.
  double force_of_calculix(fe::ElementModel model, const CompressionRequest& request) {
    fe::MeshOptions options;
    options.rule = request.rule;
    options.inp.compression = request.compression;
    MemoryBudget budget;
    fe::make_mesh(std::move(model), options, budget, folder_.path() / "job.inp");
    const std::string command =
        "cd " + folder_.path().string() + " && OMP_NUM_THREADS=2 timeout -s KILL 120 ccx job >job.log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text_file(folder_.path() / "job.log");
    std::ifstream in(folder_.path() / "job.dat");
    Vec3 base = Vec3::Constant(std::nan(""));
    for (std::string line; std::getline(in, line);)
      if (line.find("total force") != std::string::npos && line.find("MIN") != std::string::npos)
        in >> base.x() >> base.y() >> base.z();
    return base[request.compression.axis];
  }

  void TearDown() override {
    if (compared_ > 0)
      std::cout << compared_ << " compared, greatest difference " << 100.0 * greatest_ << " %\n";
  }

  ream::test::TemporaryFolder folder_;
  double greatest_ = 0.0;
  int compared_ = 0;
};

CompressionRequest request_of(int i) {
  CompressionRequest request;
  request.rule.law = fe::linear_law(10.0, 50.0);
  request.rule.bin_width_mpa = 250.0;
  request.rule.poisson = i % 5 == 4 ? 0.45 : 0.3;
  request.compression = {i % 3, 0.01, i % 2 == 1};
  return request;
}

TEST_F(AgainstCalculix, TwentyCropsOfMicroCt) {
  REAM_SKIP_WITHOUT_CCX();
  const std::filesystem::path file = ream::test::shared_data("microct/LHDL_3155_D_4_bc_200cube_19.5um.nrrd");
  REAM_SKIP_WITHOUT(file);
  const ct::GrayVolume volume(file);
  constexpr int edge = 13;
  const size_t row = static_cast<size_t>(volume.dims().x()),
               layer = row * static_cast<size_t>(volume.dims().y());
  std::vector<int32_t> gray;
  for (int w = 0; w < volume.dims().z(); ++w) {
    gray.resize(gray.size() + layer);
    volume.read_layer(w, std::span(gray).last(layer));
  }
  std::mt19937_64 random(ream::test::seed(46));
  for (int i = 0; i < 200 && compared_ < 20; ++i) {
    const Vec3i first(static_cast<int>(random() % 187), static_cast<int>(random() % 187),
                      static_cast<int>(random() % 187));
    // Bone alone, and every second time the marrow too.
    const int least = compared_ % 2 == 0 ? 142 : 0;
    const auto model = [&] {
      return fe::test::model_of({edge, edge, edge}, [&](int u, int v, int w) {
        const Vec3i at = first + Vec3i(u, v, w);
        const int g = gray[static_cast<size_t>(at.x()) + row * static_cast<size_t>(at.y()) +
                           layer * static_cast<size_t>(at.z())];
        return g >= least ? g : -1;
      });
    };
    fe::ElementModel bone = model();
    MemoryBudget budget;
    if (bone.codes.size() < 200) continue;
    keep_largest_component(bone, budget);
    if (bone.codes.size() >= 200) compare(model, request_of(compared_));
  }
  EXPECT_EQ(compared_, 20);
}

TEST_F(AgainstCalculix, VoxelsAtRandom) {
  REAM_SKIP_WITHOUT_CCX();
  const uint64_t seed = ream::test::seed(47);
  for (int i = 0; i < 6; ++i) {
    const Vec3i dims(9 + i, 12, 11);
    const fe::test::RandomGray gray(dims, i % 2 == 0 ? 0.6 : 1.0, seed + static_cast<uint64_t>(i));
    compare([&] { return fe::test::model_of(dims, gray, 0.3); }, request_of(i));
  }
}

}  // namespace
}  // namespace ream::solve::test
