#pragma once
#include "bench/bench.hpp"
#include "case/case.hpp"
#include "shell/point_shell.hpp"

// The parts of the collide suite, one file each.
namespace ream::bench {

/// Whole ticks of a simulated reaming of `thesis-5-4-2`, removal included.
std::vector<Row> tick_rows(const case_::Case& bone_case);

/// Contact alone with 5 and 20 % of all points in the bone of `thesis-5-4-2`, against the thesis' flat kernel
/// on the same device. The pilot hole is cut into a copy of the bone.
std::vector<Row> share_inside_rows(const case_::Case& bone_case);

/// What the bone of `thesis-5-4-2` and a shell cost in memory (table 4.4's question).
std::vector<Row> memory_rows(const case_::Case& bone_case, const shell::PointShell& shell);

/// Tables 4.1 and 4.3 to 4.5 of the thesis and its figure 4.4, with the methods that it compares.
std::vector<Row> thesis_tables(const Options& options);

}  // namespace ream::bench
