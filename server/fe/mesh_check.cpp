#include "fe/mesh_check.hpp"

#include <cmath>

#include "core/error.hpp"
#include "fe/mesh_file_checks.hpp"
#include "fe/number_text.hpp"

namespace ream::fe {
namespace {

/// Of an element's edge, for coordinates rounded when written.
constexpr double place_tolerance = 1e-2;
constexpr double volume_tolerance = 1e-5;

/// Ticks voxels off as elements are found in their places.
class VoxelTicks {
 public:
  explicit VoxelTicks(const ElementModel& model) : model_(model), found_(model.mask.dims()) {}

  void operator()(const HexCorners& corners) {
    const Vec3 spacing = model_.spacing_mm;
    const Vec3 at = ((corners[0] - model_.origin_mm).array() / spacing.array()).matrix();
    const Vec3i voxel = (at.array() + 0.5).floor().cast<int>().matrix();
    const Vec3 size = ((corners[6] - corners[0]).array() / spacing.array()).matrix();
    const bool in_place = (at - voxel.cast<double>()).cwiseAbs().maxCoeff() < place_tolerance &&
                          (size - Vec3::Ones()).cwiseAbs().maxCoeff() < place_tolerance;
    const bool inside = (voxel.array() >= 0).all() && (voxel.array() < model_.mask.dims().array()).all();
    if (in_place && inside && model_.mask.at(voxel.x(), voxel.y(), voxel.z()) &&
        !found_.at(voxel.x(), voxel.y(), voxel.z()))
      found_.set(voxel.x(), voxel.y(), voxel.z());
    else
      ++wrong_;
  }
  uint64_t wrong() const { return wrong_; }

 private:
  const ElementModel& model_;
  VoxelMask found_;
  uint64_t wrong_ = 0;
};

}  // namespace

MeshFacts check_mesh_file(const std::filesystem::path& path, MeshFormat format, const MemoryBudget& budget,
                          const Progress& progress, const ElementVisitor& visit) {
  return format == MeshFormat::inp ? check_inp(path, budget, progress, visit)
                                   : check_vtu(path, budget, progress, visit);
}

MeshFacts check_mesh_file(const std::filesystem::path& path, MeshFormat format, const NumberedMesh& mesh,
                          MemoryBudget& budget, const Progress& progress) {
  const uint64_t bytes = mesh.model.mask.bytes();
  budget.take(bytes, "checking the mesh");
  VoxelTicks ticks(mesh.model);
  const MeshFacts facts = check_mesh_file(path, format, budget, progress, std::ref(ticks));
  budget.give_back(bytes);
  const auto expect = [&](const char* what, double found, double expected, double tolerance) {
    if (std::abs(found - expected) > tolerance)
      throw Error(ErrorKind::io, path.string() + " does not hold what was written: " + what + " " +
                                     real_text(found) + " instead of " + real_text(expected));
  };
  expect("nodes", static_cast<double>(facts.nodes), static_cast<double>(mesh.numbering.nodes()), 0.0);
  expect("elements", static_cast<double>(facts.elements), static_cast<double>(mesh.numbering.elements()),
         0.0);
  expect("elements that are no voxel", static_cast<double>(ticks.wrong()), 0.0, 0.0);
  expect("materials", static_cast<double>(facts.materials), static_cast<double>(mesh.materials.list.size()),
         0.0);
  const double volume = mesh.model.spacing_mm.prod() * static_cast<double>(mesh.numbering.elements());
  expect("volume", facts.volume_mm3, volume, volume_tolerance * volume);
  return facts;
}

}  // namespace ream::fe
