#pragma once
#include "render/scene_file.hpp"

namespace ream::renderer {

/// Draws a scene of at least a pixel on the processor, smoothed by twice as many pixels each way. Its mesh
/// and colours are taken as they are: a triangle's vertices must be there. Throws Error: unavailable when
/// OSMesa gives no context; invalid_input for a camera that looks at itself.
render::Image draw_with_osmesa(const render::Scene& scene);

}  // namespace ream::renderer
