#pragma once
#include <cstdint>
#include <vector>

#include "case/case.hpp"
#include "record/recording.hpp"

namespace ream::session {

/// Coverage of one bone at the three moments that matter, in the order of VoxelGrid::index.
struct Coverages {
  std::vector<uint8_t> native;  ///< untouched
  std::vector<uint8_t> start;   ///< before tick 0: with the pilot hole
  std::vector<uint8_t> left;
};

/// `native_case`: the recorded_case(); its pilot hole is cut afterwards. Errors: conflict when the bone
/// before tick 0 is not the recorded one; invalid_input for a damaged recording.
Coverages coverages_of(const record::Recording& recording, case_::Case& native_case);

}  // namespace ream::session
