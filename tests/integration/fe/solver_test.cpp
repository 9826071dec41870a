#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <Eigen/Geometry>
#include "ct/read/gray_volume.hpp"
#include "support/shared_data.hpp"
#include "unit/fe/small_models.hpp"

namespace ream::fe::test {
namespace {

namespace fs = std::filesystem;

bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

#define REAM_SKIP_WITHOUT_CCX() \
  if (!runs("command -v ccx")) GTEST_SKIP() << "CalculiX (ccx) is not installed"

/// Forces on the two platens, N.
struct Reactions {
  Vec3 base = Vec3::Zero(), top = Vec3::Zero();
};

class Solver : public testing::Test {
 protected:
  /// Makes the mesh, lets CalculiX solve it directly, and reads the sums of forces.
  Reactions solved(ElementModel model, const MeshOptions& given) {
    MeshOptions options = given;
    if (!options.inp.compression) options.inp.compression = Compression{};
    options.check = true;
    MemoryBudget budget;
    report_ = make_mesh(std::move(model), options, budget, folder_.path() / "job.inp");
    const std::string command =
        "cd " + folder_.path().string() + " && OMP_NUM_THREADS=2 timeout -s KILL 120 ccx job >job.log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_text_file(folder_.path() / "job.log");
    Reactions reactions;
    std::ifstream in(folder_.path() / "job.dat");
    for (std::string line; std::getline(in, line);) {
      if (line.find("total force") == std::string::npos) continue;
      Vec3& sum = line.find("MIN") != std::string::npos ? reactions.base : reactions.top;
      in >> sum.x() >> sum.y() >> sum.z();
    }
    return reactions;
  }

  /// Displacement of a node as CalculiX wrote it.
  Vec3 displacement(long node) const {
    std::ifstream in(folder_.path() / "job.frd");
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with(" -4  DISP")) inside = true;
      if (!inside || !line.starts_with(" -1") || std::stol(line.substr(3, 10)) != node) continue;
      return {std::stod(line.substr(13, 12)), std::stod(line.substr(25, 12)), std::stod(line.substr(37, 12))};
    }
    ADD_FAILURE() << "no displacement of node " << node;
    return Vec3::Zero();
  }

  ream::test::TemporaryFolder folder_;
  MeshReport report_;
};

MeshOptions elastic(double poisson, int axis = 2) {
  MeshOptions options;
  options.rule.poisson = poisson;
  options.inp.compression = Compression{axis, 0.01, false};
  return options;
}

TEST_F(Solver, ACubeHasTheModulusAndThePoissonsRatioItWasGiven) {
  REAM_SKIP_WITHOUT_CCX();
  for (int axis = 0; axis < 3; ++axis) {
    // By hand: 2 x 2 x 2 mm of E = 1000 under 1 % gives 40 N and 0.006 mm sideways.
    const Reactions r = solved(model_of(
                                   {2, 2, 2}, [](int, int, int) { return 1000; }, 1.0),
                               elastic(0.3, axis));
    EXPECT_NEAR(r.base[axis], 40.0, 1e-4);
    EXPECT_NEAR(r.base[axis] + r.top[axis], 0.0, 40.0 * 1e-5);
    const Vec3 moved = displacement(27) - displacement(1);
    EXPECT_NEAR(moved[axis], -0.02, 1e-7);
    EXPECT_NEAR(moved[(axis + 1) % 3], 0.006, 1e-7);
    EXPECT_NEAR(moved[(axis + 2) % 3], 0.006, 1e-7);
  }
}

TEST_F(Solver, LayersInSeriesAreReussAndInParallelVoigt) {
  REAM_SKIP_WITHOUT_CCX();
  const auto layered = [](int along) {
    return model_of(
        {2, 2, 2},
        [=](int u, int v, int w) {
          return (along == 2 ? w : along == 1 ? v : u) == 0 ? 18000 : 500;
        },
        1.0);
  };
  const double reuss = 2.0 / (1.0 / 18000 + 1.0 / 500), voigt = (18000.0 + 500.0) / 2;
  EXPECT_NEAR(solved(layered(2), elastic(0.0)).base.z(), reuss * 0.04, reuss * 0.04 * 1e-6);  // 38.9189 N
  EXPECT_NEAR(solved(layered(0), elastic(0.0)).base.z(), voigt * 0.04, voigt * 0.04 * 1e-6);  // 370 N
}

TEST_F(Solver, RotationAndExpansionAreFreeOnSlidingPlatensOnly) {
  REAM_SKIP_WITHOUT_CCX();
  MeshOptions options = elastic(0.3);
  options.inp.compression->fixed_platens = true;
  const Reactions r = solved(model_of(
                                 {3, 3, 3}, [](int, int, int) { return 1000; }, 1.0),
                             options);
  EXPECT_GT(r.base.z(), 90.0 * 1.001);  // held sideways it is stiffer
  EXPECT_NEAR(r.base.z() + r.top.z(), 0.0, 90.0 * 1e-5);
}

/// Modulus of the box around the mesh beside its bounds, which hold for one Poisson's ratio throughout.
void expect_between_bounds(const MeshReport& report, const Reactions& r, bool full) {
  const double box_mm3 = report.box_volume_mm3, voxel_mm3 = report.spacing_mm.prod();
  double voigt = 0.0, compliance = 0.0;
  for (const Material& m : report.materials) {
    const double share = static_cast<double>(m.elements) * voxel_mm3 / box_mm3;
    voigt += share * m.modulus_mpa;
    compliance += share / m.modulus_mpa;
  }
  const double height_mm = 20 * report.spacing_mm.z(), area_mm2 = box_mm3 / height_mm;
  const double modulus = r.base.z() / area_mm2 / 0.01;
  EXPECT_NEAR(r.base.z() + r.top.z(), 0.0, 1e-5 * r.base.z());
  EXPECT_LT(modulus, voigt * (1.0 + 1e-6));
  EXPECT_GT(modulus, full ? (1.0 / compliance) * (1.0 - 1e-6) : 0.0);
  std::cout << "modulus " << modulus << " MPa, Voigt " << voigt << ", Reuss "
            << (full ? 1.0 / compliance : 0.0) << ", " << report.elements << " elements, balance "
            << (r.base.z() + r.top.z()) / r.base.z() << '\n';
}

/// A block of 20^3 voxels from (x,y,z) of the micro-CT, below `threshold` empty.
ElementModel crop(const ct::GrayVolume& volume, const Vec3i& first, int threshold) {
  std::vector<int32_t> layer(static_cast<size_t>(volume.dims().x()) * static_cast<size_t>(volume.dims().y()));
  std::vector<int> gray;
  for (int w = 0; w < 20; ++w) {
    volume.read_layer(first.z() + w, layer);
    for (int v = 0; v < 20; ++v)
      for (int u = 0; u < 20; ++u)
        gray.push_back(layer[static_cast<size_t>(first.x() + u + volume.dims().x() * (first.y() + v))]);
  }
  return model_of(
      {20, 20, 20},
      [&](int u, int v, int w) {
        const int g = gray[static_cast<size_t>(u + 20 * (v + 20 * w))];
        return g >= threshold ? g : -1;
      },
      volume.spacing_mm().x());
}

TEST_F(Solver, CropsOfMicroCtLieBetweenReussAndVoigt) {
  REAM_SKIP_WITHOUT_CCX();
  const fs::path file = ream::test::shared_data("microct/LHDL_3155_D_4_bc_200cube_19.5um.nrrd");
  REAM_SKIP_WITHOUT(file);
  const ct::GrayVolume volume(file);
  MeshOptions options = elastic(0.3);
  options.rule.law = linear_law(10.0, 50.0);
  options.rule.bin_width_mpa = 250.0;
  // All of it, marrow soft: 8,000 elements, both bounds mean something. Then bone alone.
  for (const Vec3i& first : {Vec3i(90, 90, 90), Vec3i(30, 120, 60)}) {
    const Reactions r = solved(crop(volume, first, 0), options);
    expect_between_bounds(report_, r, true);
  }
  const auto bone_voxels = [&](const Vec3i& at) { return crop(volume, at, 142).codes.size(); };
  Vec3i densest(0, 0, 0);
  for (int i = 0; i < 512; ++i) {
    const Vec3i at(i % 8 * 25, i / 8 % 8 * 25, i / 64 * 25);
    if ((at.array() <= 180).all() && bone_voxels(at) > bone_voxels(densest)) densest = at;
  }
  ElementModel bone = crop(volume, densest, 142);
  MemoryBudget budget;
  keep_largest_component(bone, budget);
  const MeshBounds bounds = bounds_of(bone.mask);
  ASSERT_EQ(bounds.greatest.z() - bounds.least.z(), 20) << "the crop must reach both platens";
  const Reactions r = solved(std::move(bone), options);
  expect_between_bounds(report_, r, false);
}

TEST_F(Solver, ASyntheticFoamLiesBetweenReussAndVoigt) {
  REAM_SKIP_WITHOUT_CCX();
  MeshOptions options = elastic(0.3);
  const auto graded = [](int u, int v, int w) { return 500 + 37 * ((7 * u + 11 * v + 13 * w) % 400); };
  const Reactions r = solved(model_of({12, 12, 20}, graded), options);
  expect_between_bounds(report_, r, true);
}

TEST_F(Solver, MeshioReadsBothFormats) {
  const std::string python = "/usr/bin/python3";
  if (!runs(python + " -c 'import meshio'")) GTEST_SKIP() << "meshio is not installed for " << python;
  MeshOptions options;
  options.keep_islands = true;
  options.rule.bin_width_mpa = 10.0;
  options.inp.faces = true;
  options.check = true;
  const RandomGray gray({12, 9, 7}, 0.5, 21);
  MemoryBudget budget;
  for (const char* name : {"m.inp", "m.vtu"})
    report_ = make_mesh(model_of({12, 9, 7}, gray), options, budget, folder_.path() / name);
  folder_.write(
      "read.py",
      "import meshio, numpy\n"
      "for name in ('m.inp', 'm.vtu'):\n"
      "    m = meshio.read(name)\n"
      "    cells = numpy.concatenate([c.data for c in m.cells if c.type == 'hexahedron'])\n"
      "    p = m.points[cells]\n"
      "    e = p[:, 1] - p[:, 0], p[:, 3] - p[:, 0], p[:, 4] - p[:, 0]\n"
      "    v = numpy.einsum('ij,ij->i', numpy.cross(e[0], e[1]), e[2])\n"
      "    print(name, len(m.points), len(cells), v.min() > 0, '%g' % v.sum())\n"
      "    if name == 'm.inp':\n"
      "        print(sorted(k for k in m.point_sets), sum(k.startswith('SET_') for k in m.cell_sets))\n"
      "    else:\n"
      "        print(sorted(m.cell_data), m.cell_data['material'][0].max())\n");
  ASSERT_EQ(std::system(("cd " + folder_.path().string() + " && timeout -s KILL 60 " + python +
                         " read.py > read.out 2>&1")
                            .c_str()),
            0)
      << read_text_file(folder_.path() / "read.out");
  const std::string counts =
      std::to_string(report_.nodes) + " " + std::to_string(report_.elements) + " True ";
  std::ostringstream volume;
  volume << report_.volume_mm3;
  const std::string materials = std::to_string(report_.materials.size());
  EXPECT_EQ(read_text_file(folder_.path() / "read.out"),
            "m.inp " + counts + volume.str() + "\n['XMAX', 'XMIN', 'YMAX', 'YMIN', 'ZMAX', 'ZMIN'] " +
                materials + "\n" + "m.vtu " + counts + volume.str() +
                "\n['gray', 'material', 'modulus_MPa'] " + materials + "\n");
}

}  // namespace
}  // namespace ream::fe::test
