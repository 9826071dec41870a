#pragma once
#include <filesystem>

#include "app/export_session.hpp"

namespace ream::app {

// What a session left, as files for other programs: world frame (LPS), mm. The implant goes along where one
// can be seated. Errors: those of reamed_bone(); io.

/// Binary STL of the bone, and beside it FILE-implant.stl.
void write_stl(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
/// PLY of bone and implant, coloured by deviation from the plan, with properties deviation_plan and
/// deviation_implant (score/deviation.hpp).
void write_coloured_ply(const ExportRequest& request, const std::filesystem::path& out,
                        const Progress& progress);
/// GLB of bone and implant, coloured by deviation from the plan.
void write_glb(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
/// Deviations alone (score/deviation_file.hpp), in the order of the vertices of the PLY file and of
/// reamed.ply.
void write_deviations(const ExportRequest& request, const std::filesystem::path& out,
                      const Progress& progress);

}  // namespace ream::app
