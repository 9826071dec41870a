#pragma once
#include "score/component.hpp"
#include "score/findings.hpp"

namespace ream::score {

/// How deep the reamer's apex is along the planned axis when it first touches the untouched face; empty when
/// it does not.
std::optional<double> first_contact_mm(const NativeGlenoid& native);

/// What is asked of the session before it begins: angles of the plan, and how much reaming alone is to
/// correct.
void say_plan(const Task& task, Findings& findings);

/// Achieved axis against the plan: angles, entry, centre, depth. `line`: frame of the lattice.
void say_alignment(const NativeGlenoid& native, const CutLine& line, double reaming_depth_mm,
                   Findings& findings);

/// Angles of the plane through the rim of what was reamed; `normal`: world, lateral, empty without a rim.
void say_rim(const Task& task, const std::optional<Vec3>& normal, Findings& findings);

/// Reason for everything that needs an achieved axis.
void leave_alignment(const std::string& reason, Findings& findings);

}  // namespace ream::score
