#pragma once
#include <filesystem>

#include "session/export/export_formats.hpp"

namespace ream::session {

// What a session left, as files for other programs: world frame (LPS), mm; in GLB metres with y up. Errors:
// those of reamed_bone(), of surface and picture those of case_of(); io; cancelled.

/// Binary STL of the bone.
void write_stl_bone(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
/// Binary STL of the implant. Error conflict where none can be seated.
void write_stl_implant(const ExportRequest& request, const std::filesystem::path& out,
                       const Progress& progress);
/// PLY of the bone, and of the implant where one can be seated, coloured by deviation from the plan, with
/// properties deviation_plan and deviation_implant (score/deviation.hpp).
void write_ply_scene(const ExportRequest& request, const std::filesystem::path& out,
                     const Progress& progress);
/// GLB of the same, coloured alike.
void write_glb_scene(const ExportRequest& request, const std::filesystem::path& out,
                     const Progress& progress);
/// Deviations alone (score/deviation_file.hpp), in the order of the vertices of the bone in the PLY files.
void write_deviations(const ExportRequest& request, const std::filesystem::path& out,
                      const Progress& progress);
/// PLY of the bone alone: the reamed.ply of a run.
void write_surface(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);
/// The snapshot.png of a run.
void write_snapshot(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);

}  // namespace ream::session
