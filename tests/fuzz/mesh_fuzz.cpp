// A triangle mesh: PLY and OFF, which are read here, and STL and OBJ through assimp.
#include "core/error.hpp"
#include "fuzz_file.hpp"
#include "reader/mesh_file.hpp"

namespace ream::fuzz {
namespace {

constexpr const char* names[] = {"a.ply", "a.off", "a.stl", "a.obj"};

void check(const TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const auto corner : triangle)
      require(static_cast<size_t>(corner) < mesh.vertices_mm.size(), "a triangle without a corner");
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const auto path = fuzz::folder().write(fuzz::names[input.byte() % std::size(fuzz::names)], input.rest());
  try {
    fuzz::check(reader::parse_ply(input.rest(), path));
  } catch (const Error&) {
  }
  try {
    fuzz::check(reader::read_mesh_file(path));
  } catch (const Error&) {
  }
  return 0;
}
