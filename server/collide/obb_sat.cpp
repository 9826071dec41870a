#include "collide/obb_sat.hpp"

#include <cmath>

namespace ream::collide {

bool overlap(const Obb& a, const Obb& b) noexcept {
  // b in a's axes; the small addition keeps cross products of parallel edges from separating by rounding.
  constexpr double parallel_guard = 1e-9;
  const Mat3 r = a.frame_from_box.rotation.transpose() * b.frame_from_box.rotation;
  const Mat3 abs_r = r.cwiseAbs().array() + parallel_guard;
  const Vec3 t = a.frame_from_box.rotation.transpose() *
                 (b.frame_from_box.translation_mm - a.frame_from_box.translation_mm);
  const Vec3 &ha = a.half_size, &hb = b.half_size;

  for (int i = 0; i < 3; ++i)
    if (std::abs(t[i]) > ha[i] + abs_r.row(i).dot(hb)) return false;
  for (int j = 0; j < 3; ++j)
    if (std::abs(t.dot(r.col(j))) > hb[j] + abs_r.col(j).dot(ha)) return false;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * r(i1, j) - t[i1] * r(i2, j));
      const double reach =
          ha[i1] * abs_r(i2, j) + ha[i2] * abs_r(i1, j) + hb[j1] * abs_r(i, j2) + hb[j2] * abs_r(i, j1);
      if (distance > reach) return false;
    }
  return true;
}

}  // namespace ream::collide
