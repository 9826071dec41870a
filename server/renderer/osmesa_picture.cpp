#define GL_GLEXT_PROTOTYPES
#include "renderer/osmesa_picture.hpp"

#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/osmesa.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "render/camera.hpp"

namespace ream::renderer {

using render::Camera;
using render::camera_from_world;
using render::Image;
using render::Layer;
using render::Mat4f;
using render::VertexColour;

namespace {

// GLSL 1.20 for OSMesa: `position` and `normal` in the mesh's frame (where it has none: that of the
// triangle), lit in camera coordinates by a key light above the left shoulder, a weak fill light and a sky,
// then to sRGB.

const char* const vertex_shader = R"(#version 120
attribute vec3 position;
attribute vec3 normal;
attribute vec4 vertex_colour;
uniform mat4 camera_from_mesh;
uniform mat4 clip_from_camera;
varying vec3 camera_position;
varying vec3 camera_normal;
varying vec4 own_colour;
void main() {
  own_colour = vertex_colour;
  vec4 p = camera_from_mesh * vec4(position, 1.0);
  camera_position = p.xyz;
  camera_normal = mat3(camera_from_mesh) * normal;
  gl_Position = clip_from_camera * p;
}
)";

const char* const fragment_shader = R"(#version 120
uniform vec3 colour;
uniform float opacity;
uniform bool has_normals;
uniform bool has_colours;
varying vec3 camera_position;
varying vec3 camera_normal;
varying vec4 own_colour;

vec3 srgb(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), c));
}

void main() {
  vec3 to_eye = normalize(-camera_position);
  vec3 n = has_normals ? normalize(camera_normal) : normalize(cross(dFdx(camera_position), dFdy(camera_position)));
  if (has_normals ? !gl_FrontFacing : dot(n, to_eye) < 0.0) n = -n;

  vec3 key = normalize(vec3(-0.45, 0.65, 0.75));
  vec3 fill = normalize(vec3(0.8, -0.1, 0.5));
  vec3 light = vec3(1.00, 0.98, 0.94) * (0.72 * max(dot(n, key), 0.0)) +
               vec3(0.85, 0.90, 1.00) * (0.16 * max(dot(n, fill), 0.0)) +
               mix(vec3(0.13, 0.12, 0.11), vec3(0.24, 0.25, 0.26), 0.5 + 0.5 * n.y);
  float shine = pow(max(dot(n, normalize(key + to_eye)), 0.0), 40.0);
  vec3 surface = colour;
  if (has_colours) {
    surface = pow(own_colour.rgb, vec3(2.2));
    bool stripe = mod(gl_FragCoord.x + gl_FragCoord.y, 18.0) < 5.0;
    if (own_colour.a > 0.5 && stripe) surface *= 0.25;
    light = mix(vec3(0.95), light, 0.4);
    shine = 0.0;
  }
  gl_FragColor = vec4(srgb(surface * light + vec3(0.06 * shine)), opacity);
}
)";

constexpr int oversampling = 2;
constexpr std::array<float, 3> background = {0.949f, 0.945f, 0.937f};
constexpr GLuint position_attribute = 0, normal_attribute = 1, colour_attribute = 2;

/// An OSMesa context that is current on this thread as long as it lives.
class Context {
 public:
  Context(int width, int height, std::vector<uint8_t>& pixels)
      : context_(OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr), OSMesaDestroyContext) {
    if (!context_ ||
        OSMesaMakeCurrent(context_.get(), pixels.data(), GL_UNSIGNED_BYTE, width, height) == GL_FALSE)
      throw Error(ErrorKind::unavailable, "OSMesa gives no context of " + std::to_string(width) + " x " +
                                              std::to_string(height) +
                                              " pixels; check the package libosmesa6");
    OSMesaPixelStore(OSMESA_Y_UP, 0);
  }

 private:
  std::unique_ptr<osmesa_context, void (*)(OSMesaContext)> context_;
};

GLuint compiled(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  return shader;
}

GLuint linked_program() {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, vertex_shader));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment_shader));
  glBindAttribLocation(program, position_attribute, "position");
  glBindAttribLocation(program, normal_attribute, "normal");
  glBindAttribLocation(program, colour_attribute, "vertex_colour");
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good == GL_FALSE) {
    std::array<char, 512> log{};
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw Error(ErrorKind::unavailable, std::string("OSMesa rejects the shader: ") + log.data());
  }
  return program;
}

Mat4f matrix(const Pose& pose) {
  Mat4f result = Mat4f::Identity();
  result.topLeftCorner<3, 3>() = pose.rotation.cast<float>();
  result.topRightCorner<3, 1>() = pose.translation_mm.cast<float>();
  return result;
}

/// Depths of everything drawn, along the camera's view, with a little air.
std::array<double, 2> depth_range_mm(const std::vector<Layer>& layers, const Mat4f& camera_from_world) {
  double nearest = 1e300, farthest = 0.0;
  for (const Layer& layer : layers) {
    const Mat4f camera_from_mesh = camera_from_world * matrix(layer.world_from_mesh);
    for (const Vec3f& p : layer.mesh->vertices_mm) {
      const double depth = -(camera_from_mesh.row(2).head<3>().dot(p) + camera_from_mesh(2, 3));
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  farthest = std::max(farthest * 1.01, 1.0);
  return {std::clamp(nearest * 0.99, farthest * 1e-3, farthest * 0.9), farthest};
}

void draw_mesh(const Layer& layer, const Mat4f& camera_from_world, GLuint program) {
  const TriangleMesh& mesh = *layer.mesh;
  if (mesh.triangles.empty()) return;
  const Mat4f camera_from_mesh = camera_from_world * matrix(layer.world_from_mesh);
  const bool has_normals = mesh.normals.size() == mesh.vertices_mm.size();
  const bool has_colours = layer.colours && layer.colours->size() == mesh.vertices_mm.size();
  glUniformMatrix4fv(glGetUniformLocation(program, "camera_from_mesh"), 1, GL_FALSE, camera_from_mesh.data());
  glUniform3fv(glGetUniformLocation(program, "colour"), 1, layer.colour.data());
  glUniform1f(glGetUniformLocation(program, "opacity"), layer.opacity);
  glUniform1i(glGetUniformLocation(program, "has_normals"), has_normals ? 1 : 0);
  glUniform1i(glGetUniformLocation(program, "has_colours"), has_colours ? 1 : 0);
  glEnableVertexAttribArray(position_attribute);
  glVertexAttribPointer(position_attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vec3f), mesh.vertices_mm.data());
  if (has_normals) {
    glEnableVertexAttribArray(normal_attribute);
    glVertexAttribPointer(normal_attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Vec3f), mesh.normals.data());
  }
  if (has_colours) {
    glEnableVertexAttribArray(colour_attribute);
    glVertexAttribPointer(colour_attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(VertexColour),
                          layer.colours->data());
  }
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * mesh.triangles.size()), GL_UNSIGNED_INT,
                 mesh.triangles.data());
  glDisableVertexAttribArray(position_attribute);
  glDisableVertexAttribArray(normal_attribute);
  glDisableVertexAttribArray(colour_attribute);
}

/// Depth first, then colour only where the layer is nearest to the eye: its far side does not shine through.
void draw_translucent(const Layer& layer, const Mat4f& camera_from_world, GLuint program) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_mesh(layer, camera_from_world, program);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_mesh(layer, camera_from_world, program);
  glDisable(GL_BLEND);
}

/// Translucent layers, the one that is farthest from the eye first.
std::vector<const Layer*> translucent_far_first(const std::vector<Layer>& layers, const Camera& camera) {
  std::vector<const Layer*> result;
  for (const Layer& layer : layers)
    if (layer.opacity < 1.0f) result.push_back(&layer);
  const auto distance_mm = [&](const Layer* layer) {
    return (layer->world_from_mesh.point(layer->mesh->bounds().centre()) - camera.eye_mm).norm();
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Layer* a, const Layer* b) { return distance_mm(a) > distance_mm(b); });
  return result;
}

Image downsampled(const std::vector<uint8_t>& pixels, int width, int height) {
  Image image{width, height,
              std::vector<uint8_t>(4 * static_cast<size_t>(width) * static_cast<size_t>(height))};
  const size_t row = 4 * static_cast<size_t>(width) * oversampling;
  for (size_t y = 0; y < static_cast<size_t>(height); ++y)
    for (size_t x = 0; x < static_cast<size_t>(width); ++x)
      for (size_t channel = 0; channel < 4; ++channel) {
        const uint8_t* p = pixels.data() + oversampling * y * row + size_t{4} * oversampling * x + channel;
        const int sum = p[0] + p[4] + p[row] + p[row + 4];
        image.rgba[4 * (y * static_cast<size_t>(width) + x) + channel] = static_cast<uint8_t>((sum + 2) / 4);
      }
  return image;
}

void draw_layers(const std::vector<Layer>& layers, const Camera& camera, double aspect) {
  const Mat4f view = camera_from_world(camera);
  const auto [near_mm, far_mm] = depth_range_mm(layers, view);
  const Mat4f projection =
      render::clip_from_camera(camera.vertical_field_of_view_rad, aspect, near_mm, far_mm);
  const GLuint program = linked_program();
  glUseProgram(program);
  glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_camera"), 1, GL_FALSE, projection.data());
  glClearColor(background[0], background[1], background[2], 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  for (const Layer& layer : layers)
    if (layer.opacity >= 1.0f) draw_mesh(layer, view, program);
  for (const Layer* layer : translucent_far_first(layers, camera)) draw_translucent(*layer, view, program);
  glFinish();
}

}  // namespace

Image draw_with_osmesa(const render::Scene& scene) {
  const int width = oversampling * scene.width, height = oversampling * scene.height;
  std::vector<uint8_t> pixels(4 * static_cast<size_t>(width) * static_cast<size_t>(height));
  {
    const Context context(width, height, pixels);
    glViewport(0, 0, width, height);
    draw_layers(scene.layers, scene.camera, static_cast<double>(width) / height);
  }
  return downsampled(pixels, scene.width, scene.height);
}

}  // namespace ream::renderer
