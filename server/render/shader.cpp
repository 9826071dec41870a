#include "render/shader.hpp"

namespace ream::render {

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

}  // namespace ream::render
