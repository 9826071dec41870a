#include "geometry/mesh_io.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cstring>
#include <string>
#include <unordered_map>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/lower.hpp"
#include "geometry/off.hpp"
#include "geometry/ply.hpp"

namespace ream {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string why) {
  std::replace(why.begin(), why.end(), '\n', ' ');
  throw Error(ErrorKind::invalid_input, "mesh " + path.string() + " cannot be used: " + why);
}

/// The file's parts as they stand, merged.
void append_part(const std::filesystem::path& path, const aiMesh& part, TriangleMesh& mesh) {
  const auto base = static_cast<uint32_t>(mesh.vertices_mm.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
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
    mesh.triangles.push_back(t);
  }
}

TriangleMesh load_with_assimp(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_COLORS |
                                                          aiComponent_TEXCOORDS | aiComponent_TEXTURES |
                                                          aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(
      path.string(), aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_PreTransformVertices);
  if (scene == nullptr) refuse(path, importer.GetErrorString());
  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append_part(path, *scene->mMeshes[i], mesh);
  return mesh;
}

void check_finite(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    if (!mesh.vertices_mm[i].allFinite())
      refuse(path, "vertex " + std::to_string(i) + " is not a finite number");
}

/// Gives equal positions one index, drops triangles that lose a corner by it and vertices that no triangle
/// names.
TriangleMesh joined(const TriangleMesh& mesh) {
  struct Hash {
    size_t operator()(const std::array<uint32_t, 3>& bits) const {
      return hash_combine(hash_combine(bits[0], bits[1]), bits[2]);
    }
  };
  std::unordered_map<std::array<uint32_t, 3>, uint32_t, Hash> index_of;
  TriangleMesh out;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3f, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = mesh.vertices_mm[triangle[k]] + Vec3f::Zero();  // -0 becomes 0
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    std::array<uint32_t, 3> t{};
    for (size_t k = 0; k < 3; ++k) {
      const std::array<uint32_t, 3> bits{std::bit_cast<uint32_t>(p[k].x()), std::bit_cast<uint32_t>(p[k].y()),
                                         std::bit_cast<uint32_t>(p[k].z())};
      const auto [place, is_new] = index_of.try_emplace(bits, static_cast<uint32_t>(out.vertices_mm.size()));
      if (is_new) out.vertices_mm.push_back(p[k]);
      t[k] = place->second;
    }
    out.triangles.push_back(t);
  }
  return out;
}

/// assimp takes a text STL that stops in the middle as whole.
void check_text_stl_is_whole(const std::filesystem::path& path) {
  const std::string text = read_text_file(path);
  uint32_t count = 0;
  if (text.size() >= 84) std::memcpy(&count, text.data() + 80, sizeof count);
  const bool is_binary = text.size() >= 84 && text.size() >= 84 + size_t{50} * count;
  if (text.starts_with("solid") && !is_binary && text.find("endsolid") == std::string::npos)
    refuse(path, "it is cut off");
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
  const std::string extension = lower(path.extension().string());
  // Other readers of assimp were seen to abort the program on damaged files.
  if (extension != ".stl" && extension != ".obj" && extension != ".glb" && extension != ".ply" &&
      extension != ".off")
    refuse(path, "its name must end in .stl, .obj, .ply, .off or .glb");
  if (extension == ".stl") check_text_stl_is_whole(path);
  const TriangleMesh read = extension == ".ply"   ? parse_ply(read_text_file(path), path)
                            : extension == ".off" ? parse_off(read_text_file(path), path)
                                                  : load_with_assimp(path);
  check_finite(path, read);
  TriangleMesh mesh = joined(read);
  if (mesh.triangles.empty()) refuse(path, "it holds no triangles");
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
