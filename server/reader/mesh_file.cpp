#include "reader/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/text.hpp"

namespace ream::reader {
namespace {

/// What is wrong with the file; parse_off adds its name.
struct OffFault {
  std::string what;
};

/// Takes line after line, words apart, without comments and empty lines.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  std::vector<std::string_view> next() {
    while (!rest_.empty()) {
      const size_t end = std::min(rest_.find('\n'), rest_.size());
      std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      line = line.substr(0, line.find('#'));
      std::vector<std::string_view> words;
      for (size_t begin = 0; (begin = line.find_first_not_of(" \t\r", begin)) != std::string_view::npos;) {
        const size_t stop = std::min(line.find_first_of(" \t\r", begin), line.size());
        words.push_back(line.substr(begin, stop - begin));
        begin = stop;
      }
      if (!words.empty()) return words;
    }
    throw OffFault{"it is cut off"};
  }

 private:
  std::string_view rest_;
};

template <class Number>
Number number_of(std::string_view word) {
  Number value{};
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failed != std::errc{} || end != word.data() + word.size())
    throw OffFault{"it has a word where a number is expected"};
  return value;
}

void add_face(const std::vector<std::string_view>& words, TriangleMesh& mesh) {
  const auto corners = number_of<uint32_t>(words[0]);
  if (corners >= words.size()) throw OffFault{"a face names fewer vertices than it says"};
  std::vector<uint32_t> indices;
  for (uint32_t i = 1; i <= corners; ++i) {
    indices.push_back(number_of<uint32_t>(words[i]));
    if (indices.back() >= mesh.vertices_mm.size())
      throw OffFault{"a triangle names a vertex that does not exist"};
  }
  for (size_t k = 2; k < indices.size(); ++k)
    mesh.triangles.push_back({indices[0], indices[k - 1], indices[k]});
}

TriangleMesh parse(std::string_view text) {
  Lines lines(text);
  std::vector<std::string_view> counts = lines.next();
  if (!counts[0].ends_with("OFF")) throw OffFault{"it does not begin as an OFF file"};
  counts.erase(counts.begin());
  if (!counts.empty() && counts[0] == "BINARY")
    throw OffFault{"it is a binary OFF file; only text is understood"};
  if (counts.empty()) counts = lines.next();
  if (counts.size() < 2) throw OffFault{"it does not say how many vertices and faces it has"};
  const auto vertices = number_of<uint32_t>(counts[0]), faces = number_of<uint32_t>(counts[1]);
  TriangleMesh mesh;
  for (uint32_t i = 0; i < vertices; ++i) {
    const std::vector<std::string_view> words = lines.next();
    if (words.size() < 3) throw OffFault{"vertex " + std::to_string(i) + " has fewer than three coordinates"};
    mesh.vertices_mm.emplace_back(number_of<float>(words[0]), number_of<float>(words[1]),
                                  number_of<float>(words[2]));
  }
  for (uint32_t i = 0; i < faces; ++i) add_face(lines.next(), mesh);
  return mesh;
}

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

}  // namespace

TriangleMesh parse_off(std::string_view text, const std::filesystem::path& path) {
  try {
    return parse(text);
  } catch (const OffFault& fault) {
    throw Error(ErrorKind::invalid_input, "mesh " + path.string() + " cannot be used: " + fault.what);
  }
}

TriangleMesh read_mesh_file(const std::filesystem::path& path) {
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

}  // namespace ream::reader
