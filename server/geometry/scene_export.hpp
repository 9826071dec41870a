#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace ream {

/// One signed byte a vertex, by a name of [a-z_]+.
struct VertexProperty {
  std::string name;
  std::vector<int8_t> values;
};

/// One object of a file; the mesh outlives it.
struct SceneObject {
  std::string name;  ///< "bone"
  const TriangleMesh* mesh = nullptr;
  std::vector<std::array<uint8_t, 3>> colours;  ///< sRGB, one a vertex; empty: none
  std::vector<VertexProperty> properties;       ///< one value a vertex each; PLY only
};

// Files of objects whose coordinates are mm in LPS; `remark` says so in one line, where the format has a
// place for it. Binary, little-endian.

/// STL of one object; the remark stands in the header, cut to 79 letters.
std::string stl_of(const TriangleMesh& mesh, const std::string& remark);

/// PLY of all objects in one list, told apart by the face property `object` (0 for the first). Colours and
/// properties are those of the objects that have them; others are white, and -128.
std::string ply_of(std::span<const SceneObject> objects, const std::string& remark);

/// GLB. glTF is in metres with y up: the root node (named by the remark) turns and scales, vertices stay LPS
/// mm. Error io when it cannot be made.
std::string glb_of(std::span<const SceneObject> objects, const std::string& remark);

}  // namespace ream
