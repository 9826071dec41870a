#pragma once
#include <filesystem>
#include <vector>

#include "bench/bench.hpp"
#include "case/case.hpp"

namespace ream::bench {

/// How soon random moments of an hour's recording of that case open: the bone alone, and until its surface
/// and the trace before it are with a viewer. The hour is reaming at full thrust, spread out, written by the
/// real recorder into `folder`.
void add_seek_rows(const case_::Case& bone_case, const std::filesystem::path& folder, std::vector<Row>& rows);

}  // namespace ream::bench
