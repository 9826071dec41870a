#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "score/component.hpp"
#include "score/metric_results.hpp"

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

/// What holds a component in the vault.
struct Fixation {
  std::string_view name;
  std::vector<Peg> pegs;
  std::vector<Keel> keels;
};

/// Virtual fixations of usual size (engineering judgement): "pegs", a central one and two beside it on the
/// superior-inferior line; "keel".
std::span<const Fixation> fixations();
const Fixation& fixation_named(std::string_view name);

/// Points of its surface about 1 mm apart, from 2 mm below the back to the tips: (anterior, superior, into
/// the bone) from the middle of the back, mm.
std::vector<Vec3> surface_points(const Fixation& fixation);

/// How far pegs, keel and the tool at its deepest stay from the outer cortex. `line`: frame of the lattice.
void measure_vault_clearance(const NativeGlenoid& native, const Component& component, const CutLine& line,
                             MetricResults& results);

}  // namespace ream::score
