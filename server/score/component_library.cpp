#include "score/component_library.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/units.hpp"

namespace ream::score {
namespace {

constexpr double below_back_mm = 2.0, apart_mm = 1.0;
constexpr int corners_of_peg = 24;
constexpr size_t pegged_medium = 1, keeled_medium = 4;

int parts(double length_mm) { return std::max(1, static_cast<int>(std::ceil(length_mm / apart_mm))); }

std::vector<Vec3> points_of(const Peg& peg) {
  std::vector<Vec3> points;
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
  return points;
}

/// The outline of every level; its widest is at the back.
std::vector<Vec3> points_of(const Keel& keel) {
  std::vector<Vec3> points;
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
  return points;
}

bool same_letters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

std::span<const LibraryComponent> component_library() {
  static const std::vector<LibraryComponent> all{
      {"pegged small", 4.0, {{0.0, 0.0, 6.0, 13.0}, {0.0, 8.0, 4.0, 9.0}, {0.0, -8.0, 4.0, 9.0}}, {}},
      {"pegged medium", 4.0, {{0.0, 0.0, 7.0, 15.0}, {0.0, 9.0, 4.5, 10.0}, {0.0, -9.0, 4.5, 10.0}}, {}},
      {"pegged large", 4.0, {{0.0, 0.0, 7.5, 17.0}, {0.0, 11.0, 5.0, 11.0}, {0.0, -11.0, 5.0, 11.0}}, {}},
      {"keeled small", 4.0, {}, {{15.0, 3.5, 10.0, 2.2, 11.0}}},
      {"keeled medium", 4.0, {}, {{18.0, 4.0, 12.0, 2.5, 13.0}}},
      {"keeled large", 4.0, {}, {{21.0, 4.5, 14.0, 2.8, 15.0}}}};
  return all;
}

const LibraryComponent* find_component(std::string_view name) {
  for (const LibraryComponent& component : component_library())
    if (same_letters(component.name, name)) return &component;
  return nullptr;
}

const LibraryComponent& virtual_component() { return component_library()[pegged_medium]; }

const LibraryComponent& virtual_keel() { return component_library()[keeled_medium]; }

const LibraryComponent& component_of(const std::optional<case_::Plan>& plan) {
  const LibraryComponent* named = plan ? find_component(plan->implant_size) : nullptr;
  return named ? *named : virtual_component();
}

std::vector<std::vector<Vec3>> surface_points(const LibraryComponent& component) {
  std::vector<std::vector<Vec3>> all;
  for (const Peg& peg : component.pegs) all.push_back(points_of(peg));
  for (const Keel& keel : component.keels) all.push_back(points_of(keel));
  return all;
}

}  // namespace ream::score
