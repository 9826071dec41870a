#include "bench/voxelize/benchmark_meshes.hpp"

#include <zlib.h>

#include "core/error.hpp"
#include "geometry/mesh_io.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

namespace ream::bench {
namespace {

std::string unpacked(const std::filesystem::path& path) {
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) throw Error(ErrorKind::io, "cannot read " + path.string());
  std::string text;
  char piece[65536];
  for (int read = 0; (read = gzread(file, piece, sizeof piece)) > 0;)
    text.append(piece, static_cast<size_t>(read));
  gzclose(file);
  return text;
}

}  // namespace

const std::vector<BenchmarkMesh>& benchmark_meshes() {
  static const std::vector<BenchmarkMesh> meshes = {
      {"teapot_894", "mesh/teapot_894.stl", 63.17, false},
      {"bunny_16301", "mesh/bunny_16301.ply", 15.55, false},
      {"dragon_202520", "mesh/dragon_202520.ply.gz", 56.37, false},
      {"reamer_4006", "mesh/reamer_4006.stl", 36.50, true},
      {"scapula_28106", "mesh/scapula_right_openforge_28106.stl", 144.76, true}};
  return meshes;
}

std::optional<TriangleMesh> load_benchmark_mesh(const BenchmarkMesh& which) {
  const std::filesystem::path path = test::shared_data(which.file);
  if (!std::filesystem::exists(path)) return std::nullopt;
  const test::TemporaryFolder folder;
  TriangleMesh mesh =
      load_mesh(path.extension() == ".gz" ? folder.write(path.stem().string(), unpacked(path)) : path);
  const Aabb box = mesh.bounds();
  const auto scale = static_cast<float>(which.longest_mm / (box.max - box.min).maxCoeff());
  for (Vec3f& vertex : mesh.vertices_mm) vertex *= scale;
  return mesh;
}

}  // namespace ream::bench
