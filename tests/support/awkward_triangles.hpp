#pragma once
#include <random>
#include <string>

#include "geometry/triangle_mesh.hpp"

namespace ream::test {

/// One triangle of every kind that voxelizers get wrong, its corners in voxels of a grid of `dims` voxels.
struct AwkwardTriangle {
  std::string kind;
  std::array<Vec3f, 3> corners;
};

/// The `number`-th: any, small, tiny, sliver, needle (two corners nearly the same), flat along an axis, on
/// grid planes, edges on grid lines, a line, a point, huge (reaching far out of the grid), huge sliver.
inline AwkwardTriangle awkward_triangle(std::mt19937& random, int number, const Vec3i& dims) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const auto anywhere = [&] {
    return Vec3f(unit(random) * static_cast<float>(dims.x()), unit(random) * static_cast<float>(dims.y()),
                 unit(random) * static_cast<float>(dims.z()));
  };
  const auto near = [&](const Vec3f& p, float reach) -> Vec3f {
    return p + reach * Vec3f(unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f);
  };
  const auto on_line = [&](const Vec3f& a, const Vec3f& b) -> Vec3f { return a + unit(random) * (b - a); };
  const Vec3f p = anywhere();
  const int axis = static_cast<int>(random() % 3);
  switch (number % 12) {
    case 0: return {"any", {p, near(p, 24.0f), near(p, 24.0f)}};
    case 1: return {"small", {p, near(p, 4.0f), near(p, 4.0f)}};
    case 2: return {"tiny", {p, near(p, 1e-3f), near(p, 1e-3f)}};
    case 3: {
      const Vec3f q = near(p, 40.0f);
      return {"sliver", {p, q, near(on_line(p, q), 1e-4f)}};
    }
    case 4: {
      const Vec3f q = near(p, 30.0f);
      return {"needle", {p, q, near(q, std::pow(10.0f, -6.0f * unit(random)))}};
    }
    case 5: {
      AwkwardTriangle t{"flat along an axis", {p, near(p, 20.0f), near(p, 20.0f)}};
      t.corners[1][axis] = t.corners[2][axis] = p[axis];
      return t;
    }
    case 6: {
      AwkwardTriangle t{"on a grid plane", {p, near(p, 20.0f), near(p, 20.0f)}};
      for (Vec3f& corner : t.corners) corner[axis] = std::floor(p[axis]);
      return t;
    }
    case 7: {
      AwkwardTriangle t{"corners on grid points", {p, near(p, 12.0f), near(p, 12.0f)}};
      for (Vec3f& corner : t.corners) corner = corner.array().floor();
      return t;
    }
    case 8: {
      const Vec3f q = near(p, 30.0f);
      return {"line", {p, q, on_line(p, q)}};
    }
    case 9: return {"point", {p, p, p}};
    case 10: return {"huge", {near(p, 3000.0f), near(p, 3000.0f), near(p, 3000.0f)}};
    default: {
      const Vec3f q = near(p, 4000.0f), r = p - (q - p);
      return {"huge sliver", {r, q, near(on_line(r, q), std::pow(10.0f, -5.0f * unit(random)))}};
    }
  }
}

}  // namespace ream::test
