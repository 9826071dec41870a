#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "case/case.hpp"

namespace ream::score {

/// A round peg on a component's back, mm.
struct Peg {
  double anterior_mm = 0.0, superior_mm = 0.0;  ///< of its axis from the middle of the back
  double diameter_mm = 5.0;
  double length_mm = 10.0;  ///< below the middle of the back
};

/// A keel along the superior-inferior line, mm; it tapers from the back to its tip.
struct Keel {
  double height_mm = 18.0, thickness_mm = 4.0;
  double tip_height_mm = 12.0, tip_thickness_mm = 2.5;
  double length_mm = 13.0;
};

/// A glenoid component: how thick it is at its middle, from its back to its articular surface, and what holds
/// it in the vault.
struct LibraryComponent {
  std::string_view name;
  double thickness_mm = 4.0;
  std::vector<Peg> pegs;
  std::vector<Keel> keels;
};

/// Components of usual kind and size, no maker's: polyethylene, 4 mm thick, with a central peg and two beside
/// it on the superior-inferior line, or with a keel. All sizes are engineering judgement.
std::span<const LibraryComponent> component_library();
/// By its name in the library, upper or lower case; null when there is none.
const LibraryComponent* find_component(std::string_view name);
/// "pegged medium", which stands for a component that is not known.
const LibraryComponent& virtual_component();
/// The keeled one of the same size.
const LibraryComponent& virtual_keel();
/// The one that a plan's implant_size names; the virtual one where it names none, or one of a maker that the
/// library does not have.
const LibraryComponent& component_of(const std::optional<case_::Plan>& plan);

/// Points of the surface of each peg, then of each keel, about 1 mm apart, from 2 mm below the back to the
/// tip: (anterior, superior, into the bone) from the middle of the back, mm.
std::vector<std::vector<Vec3>> surface_points(const LibraryComponent& component);

}  // namespace ream::score
