#include "score/fixation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/units.hpp"

namespace ream::score {
namespace {

constexpr double below_back_mm = 2.0, apart_mm = 1.0;
constexpr int corners_of_peg = 16;

int parts(double length_mm) { return std::max(1, static_cast<int>(std::ceil(length_mm / apart_mm))); }

void add_peg(const Peg& peg, std::vector<Vec3>& points) {
  const int levels = parts(peg.length_mm - below_back_mm);
  for (int level = 0; level <= levels; ++level) {
    const double z = below_back_mm + (peg.length_mm - below_back_mm) * level / levels;
    for (int corner = 0; corner < corners_of_peg; ++corner) {
      const double angle = 2.0 * pi * corner / corners_of_peg, radius = 0.5 * peg.diameter_mm;
      points.emplace_back(peg.anterior_mm + radius * std::cos(angle),
                          peg.superior_mm + radius * std::sin(angle), z);
    }
  }
  points.emplace_back(peg.anterior_mm, peg.superior_mm, peg.length_mm);
}

/// The outline of every level; its widest is at the back.
void add_keel(const Keel& keel, std::vector<Vec3>& points) {
  const int levels = parts(keel.length_mm - below_back_mm), rows = parts(keel.height_mm);
  for (int level = 0; level <= levels; ++level) {
    const double z = below_back_mm + (keel.length_mm - below_back_mm) * level / levels;
    const double t = z / keel.length_mm;
    const double half_height = 0.5 * (keel.height_mm + t * (keel.tip_height_mm - keel.height_mm));
    const double half_thickness = 0.5 * (keel.thickness_mm + t * (keel.tip_thickness_mm - keel.thickness_mm));
    for (int row = 0; row <= rows; ++row)
      for (const double side : {-1.0, 1.0})
        points.emplace_back(side * half_thickness, half_height * (2.0 * row / rows - 1.0), z);
  }
}

}  // namespace

std::span<const Fixation> fixations() {
  static const std::vector<Fixation> all{
      {"pegs", {{0.0, 0.0, 7.0, 15.0}, {0.0, 9.0, 4.5, 10.0}, {0.0, -9.0, 4.5, 10.0}}, {}},
      {"keel", {}, {Keel{}}}};
  return all;
}

const Fixation& fixation_named(std::string_view name) {
  for (const Fixation& fixation : fixations())
    if (fixation.name == name) return fixation;
  throw std::invalid_argument("no fixation " + std::string(name));
}

std::vector<Vec3> surface_points(const Fixation& fixation) {
  std::vector<Vec3> points;
  for (const Peg& peg : fixation.pegs) add_peg(peg, points);
  for (const Keel& keel : fixation.keels) add_keel(keel, points);
  return points;
}

}  // namespace ream::score
