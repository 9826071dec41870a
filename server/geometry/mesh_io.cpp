#include "geometry/mesh_io.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <string>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::invalid_input, "mesh " + path.string() + " cannot be used: " + why);
}

bool is_degenerate(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  return mesh.vertices_mm[t[0]] == mesh.vertices_mm[t[1]] || mesh.vertices_mm[t[1]] == mesh.vertices_mm[t[2]] ||
         mesh.vertices_mm[t[2]] == mesh.vertices_mm[t[0]];
}

void append_part(const std::filesystem::path& path, const aiMesh& part, TriangleMesh& mesh) {
  const auto base = static_cast<uint32_t>(mesh.vertices_mm.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
      refuse(path, "vertex " + std::to_string(i) + " is not a finite number");
    mesh.vertices_mm.emplace_back(v.x, v.y, v.z);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    std::array<uint32_t, 3> t{};
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices)
        refuse(path, "triangle " + std::to_string(i) + " names a vertex that does not exist");
      t[k] = base + face.mIndices[k];
    }
    if (!is_degenerate(mesh, t)) mesh.triangles.push_back(t);
  }
}

template <typename T>
void append(std::string& out, const T* values, size_t count) {
  out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::exists(path, failed))
    throw Error(ErrorKind::not_found, "no such mesh: " + path.string());
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_COLORS |
                                                          aiComponent_TEXCOORDS | aiComponent_TEXTURES |
                                                          aiComponent_MATERIALS);
  const aiScene* scene =
      importer.ReadFile(path.string(), aiProcess_Triangulate | aiProcess_RemoveComponent |
                                           aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices);
  if (scene == nullptr) refuse(path, importer.GetErrorString());
  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append_part(path, *scene->mMeshes[i], mesh);
  if (mesh.triangles.empty()) refuse(path, "it holds no triangles");
  return mesh;
}

void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const bool with_normals = mesh.normals.size() == mesh.vertices_mm.size() && !mesh.normals.empty();
  std::string out = "ply\nformat binary_little_endian 1.0\ncomment millimetres\nelement vertex " +
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
  write_file_atomically(path, out);
}

}  // namespace ream
