#pragma once

namespace ream::render {

/// GLSL 1.20 for OSMesa: `position` and `normal` in the mesh's frame (where it has none: that of the
/// triangle), lit in camera coordinates by a key light above the left shoulder, a weak fill light and a sky,
/// then to sRGB.
extern const char* const vertex_shader;
extern const char* const fragment_shader;

}  // namespace ream::render
