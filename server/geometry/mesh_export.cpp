#include "geometry/mesh_export.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Exporter.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "geometry/mesh_io.hpp"

namespace ream {
namespace {

constexpr float m_per_mm = 1.0e-3F;

void fill(const TriangleMesh& from, float scale, aiMesh& to) {
  to.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  to.mNumVertices = static_cast<unsigned>(from.vertices_mm.size());
  to.mVertices = new aiVector3D[to.mNumVertices];
  for (size_t i = 0; i < from.vertices_mm.size(); ++i) {
    const Vec3f v = scale * from.vertices_mm[i];
    to.mVertices[i] = {v.x(), v.y(), v.z()};
  }
  if (!from.normals.empty()) {
    to.mNormals = new aiVector3D[to.mNumVertices];
    for (size_t i = 0; i < from.normals.size(); ++i)
      to.mNormals[i] = {from.normals[i].x(), from.normals[i].y(), from.normals[i].z()};
  }
  to.mNumFaces = static_cast<unsigned>(from.triangles.size());
  to.mFaces = new aiFace[to.mNumFaces];
  for (size_t i = 0; i < from.triangles.size(); ++i) {
    to.mFaces[i].mNumIndices = 3;
    to.mFaces[i].mIndices = new unsigned[3];
    std::copy_n(from.triangles[i].begin(), 3, to.mFaces[i].mIndices);
  }
}

/// The library's scene owns what it points to and frees it with arrays' delete.
void fill(const TriangleMesh& mesh, float scale, aiScene& scene) {
  scene.mNumMaterials = scene.mNumMeshes = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene.mMeshes = new aiMesh* [1] { new aiMesh };
  fill(mesh, scale, *scene.mMeshes[0]);
  scene.mRootNode = new aiNode("bone");
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
}

void write_with_assimp(const std::filesystem::path& path, const TriangleMesh& mesh, const char* format,
                       float scale) {
  aiScene scene;
  fill(mesh, scale, scene);
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, format);
  if (blob == nullptr)
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + exporter.GetErrorString());
  write_file_atomically(path, std::span(static_cast<const std::byte*>(blob->data), blob->size));
}

}  // namespace

const std::vector<std::string>& mesh_file_endings() {
  static const std::vector<std::string> endings{".ply", ".stl", ".glb"};
  return endings;
}

bool is_mesh_file_ending(const std::string& ending) {
  const auto& endings = mesh_file_endings();
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, const std::string& remark) {
  const std::string ending = path.extension();
  if (ending == ".ply") return write_ply(path, mesh, remark);
  if (ending == ".stl") return write_with_assimp(path, mesh, "stlb", 1.0F);
  if (ending == ".glb") return write_with_assimp(path, mesh, "glb2", m_per_mm);
  throw Error(ErrorKind::invalid_input, path.string() + " must end in .ply, .stl or .glb");
}

}  // namespace ream
