#pragma once
#include <optional>
#include <string>

#include "geometry/triangle_mesh.hpp"

namespace ream::bench {

/// A mesh of the thesis' table 3.3, scaled so that its longest side is as there.
struct BenchmarkMesh {
  std::string name, file;
  double longest_mm = 0.0;
  bool closed = false;
};

/// Teapot, bunny, dragon, reamer, scapula: the order of the thesis.
const std::vector<BenchmarkMesh>& benchmark_meshes();

/// Nothing where the sample data are absent; the dragon is unpacked from its file.
std::optional<TriangleMesh> load_benchmark_mesh(const BenchmarkMesh& which);

}  // namespace ream::bench
