#include "geometry/mesh_io.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/file.hpp"
#include "isolation/isolated_job.hpp"

namespace ream {
namespace {

/// What each of the reader's two files may hold: the formats take at least a byte for what takes 12 here, and
/// the copies of a part, of which GLB files may have many, stay within the rest.
constexpr uint64_t max_answer_bytes(uint64_t file_bytes) { return (uint64_t{16} << 20) + 12 * file_bytes; }

template <typename T>
void append(std::string& out, const T* values, size_t count) {
  out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::exists(path, failed))
    throw Error(ErrorKind::not_found, "no such mesh: " + path.string());
  const auto bytes = std::filesystem::file_size(path, failed);
  isolation::IsolatedJob job;
  job.task = "mesh";
  job.input = path;
  job.limits.file_bytes = max_answer_bytes(failed ? 0 : bytes);
  const isolation::IsolatedResult result = isolation::run_isolated(job);
  TriangleMesh mesh;
  mesh.vertices_mm = result.values<Vec3f>("vertices", job.limits.file_bytes);
  mesh.triangles = result.values<std::array<uint32_t, 3>>("triangles", job.limits.file_bytes);
  const auto is_finite = [](const Vec3f& vertex) { return vertex.allFinite(); };
  const auto is_whole = [&](const std::array<uint32_t, 3>& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](uint32_t i) { return i < mesh.vertices_mm.size(); });
  };
  if (mesh.triangles.empty() || !std::all_of(mesh.vertices_mm.begin(), mesh.vertices_mm.end(), is_finite) ||
      !std::all_of(mesh.triangles.begin(), mesh.triangles.end(), is_whole))
    throw Error(ErrorKind::io, "the reader answered with an impossible mesh");
  return mesh;
}

std::string ply_of(const TriangleMesh& mesh, const std::string& remark) {
  const bool with_normals = mesh.normals.size() == mesh.vertices_mm.size() && !mesh.normals.empty();
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment " + remark + "\nelement vertex " +
                    std::to_string(mesh.vertices_mm.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\n";
  if (with_normals) out += "property float nx\nproperty float ny\nproperty float nz\n";
  out += "element face " + std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
  out.reserve(out.size() + mesh.vertices_mm.size() * 24 + mesh.triangles.size() * 13);
  for (size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    append(out, mesh.vertices_mm[i].data(), 3);
    if (with_normals) append(out, mesh.normals[i].data(), 3);
  }
  for (const auto& t : mesh.triangles) {
    out.push_back(3);
    append(out, t.data(), 3);
  }
  return out;
}

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh, const std::string& remark) {
  write_file_atomically(path, ply_of(mesh, remark));
}

}  // namespace ream
