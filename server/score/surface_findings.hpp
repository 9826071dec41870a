#pragma once
#include "score/component.hpp"
#include "score/findings.hpp"

namespace ream::score {

// What the bone that is left says, each part in a source of its own. Nothing of them throws or says what is
// not finite.

/// Greatest and mean depth, medialization, footprint.
void say_depths(const NativeGlenoid& native, const AchievedFace& face, Findings& findings);
/// Sphere of the reamed surface and how far it is from one.
void say_congruity(const NativeGlenoid& native, const AchievedFace& face, Findings& findings);
/// Share of the subchondral plate preserved under the component.
void say_plate(const NativeGlenoid& native, const AchievedFace& face, const Component& component,
               Findings& findings);
/// How far pegs, keel and the tool at its deepest stay from the outer cortex. `line`: frame of the lattice.
void say_vault(const NativeGlenoid& native, const Component& component, const CutLine& line,
               Findings& findings);

/// World normal, lateral, of the plane that fits the rim of what was reamed; empty without a rim.
std::optional<Vec3> rim_normal(const NativeGlenoid& native, const AchievedFace& face);

/// Reason for everything that needs bone to be measured.
void leave_bone(const std::string& reason, Findings& findings);

/// The achieved axis in the frame of the lattice; `world_from_plan`: the frame of `plan_line`.
CutLine in_lattice(const RayLattice& rays, const CutLine& plan_line, const Pose& world_from_plan);

/// Everything that bone and achieved axis say. `plan_line`: CutAxis::line(), empty when nothing was cut;
/// `world_from_plan`: its frame. `left`: what remains, with the bone at rest.
Findings surface_findings(const NativeGlenoid& native, const CoverageView& left,
                          const std::optional<CutLine>& plan_line, const Pose& world_from_plan,
                          double reaming_depth_mm);

}  // namespace ream::score
