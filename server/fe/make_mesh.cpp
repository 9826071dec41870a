#include "fe/make_mesh.hpp"

#include "core/clock.hpp"
#include "core/error.hpp"
#include "fe/element_model.hpp"
#include "fe/mesh_check.hpp"
#include "fe/mesh_writers.hpp"

namespace ream::fe {
namespace {

/// Runs a phase and says how long it took, ms.
template <typename Phase>
double timed_ms(Phase&& phase) {
  const auto start = SteadyClock::now();
  phase();
  return elapsed_us(start) * 1e-3;
}

void describe(const NumberedMesh& mesh, MeshReport& report) {
  const Vec3& spacing = mesh.model.spacing_mm;
  const double voxel_mm3 = spacing.prod();
  const MeshBounds bounds = bounds_of(mesh.model.mask);
  report.elements = mesh.numbering.elements();
  report.nodes = mesh.numbering.nodes();
  report.dims = mesh.model.mask.dims();
  report.spacing_mm = spacing;
  report.materials = mesh.materials.list;
  report.volume_mm3 = voxel_mm3 * static_cast<double>(report.elements);
  report.box_volume_mm3 = voxel_mm3 * (bounds.greatest - bounds.least).cast<double>().prod();
  for (const Material& material : report.materials)
    report.modulus_mean_mpa +=
        material.modulus_mpa * static_cast<double>(material.elements) / static_cast<double>(report.elements);
}

void write(const NumberedMesh& mesh, const MeshOptions& options, MemoryBudget& budget,
           const std::filesystem::path& out, const Progress& progress, MeshReport& report) {
  const MeshFormat format = format_of(out);
  AtomicFile file(out);
  const Progress writing = part_of(progress, 0.5, options.check ? 0.75 : 1.0);
  report.write_ms = timed_ms([&] {
    report.bytes = format == MeshFormat::inp ? write_inp(mesh, options.inp, budget, file, writing)
                                             : write_vtu(mesh, file, writing);
  });
  if (options.check)
    report.check_ms = timed_ms([&] {
      const Progress checking = part_of(progress, 0.75, 1.0);
      check_mesh_file(file.path(), format, mesh, budget, checking);
    });
  report.write_ms += timed_ms([&] { file.commit(); });
}

}  // namespace

MeshFormat format_of(const std::filesystem::path& out) {
  if (out.extension() == ".inp") return MeshFormat::inp;
  if (out.extension() == ".vtu") return MeshFormat::vtu;
  throw Error(ErrorKind::usage, out.string() + " must end in .inp (Abaqus, CalculiX) or .vtu (VTK)");
}

MeshReport make_mesh(ElementModel model, const MeshOptions& options, MemoryBudget& budget,
                     const std::filesystem::path& out, const Progress& progress) {
  format_of(out);
  MeshReport report;
  if (model.codes.size() == 0)
    throw Error(ErrorKind::invalid_input,
                "no voxel is bone, so there is nothing to mesh; give a lower --threshold or another region");
  if (!options.keep_islands)
    report.components_ms = timed_ms(
        [&] { report.components = keep_largest_component(model, budget, part_of(progress, 0.2, 0.3)); });
  report.upsample_ms = timed_ms(
      [&] { model = refined(std::move(model), options.upsample, budget, part_of(progress, 0.3, 0.45)); });
  Materials materials;
  report.materials_ms =
      timed_ms([&] { materials = make_materials(histogram_of(model.codes), model.gray, options.rule); });
  std::optional<NodeNumbering> numbering;
  report.numbering_ms = timed_ms([&] { numbering.emplace(model.mask); });
  const NumberedMesh mesh{model, *numbering, materials, options.rule};
  describe(mesh, report);
  write(mesh, options, budget, out, progress, report);
  return report;
}

}  // namespace ream::fe
