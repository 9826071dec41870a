#include <new>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.hpp"
#include "isolation/isolated_service.hpp"
#include "renderer/osmesa_picture.hpp"

namespace ream::renderer {
namespace {

using nlohmann::json;

/// The pixels lie in a file of the working folder.
json draw_task(const std::filesystem::path& input, const json& /*options*/, const Progress& /*progress*/) {
  try {
    const render::Image image = draw_with_osmesa(render::read_scene(input).scene);
    isolation::write_values("pixels", std::as_bytes(std::span(image.rgba)));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::unavailable, "this machine has not enough free memory for it");
  }
  return json::object();
}

}  // namespace
}  // namespace ream::renderer

int main() { ream::isolation::serve_one_job({{"draw", ream::renderer::draw_task}}); }
