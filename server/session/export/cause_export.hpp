#pragma once
#include "case/case.hpp"
#include "session/export/export_formats.hpp"
#include "twin/cause_parts.hpp"

namespace ream::session {

/// What the parts of a session's causes are for.
enum class CauseUse {
  verification,
  pictures  ///< also tells what bone is made of that can come to the surface
};

/// Ticks up to which the recording keeps its bone whole: of a session that was killed, images of the bricks
/// that its last ticks changed are missing.
uint32_t whole_ticks(const record::Recording& recording);

/// What computes the session's bone again anywhere, in a browser too: a file as proto/causes.md has it.
/// Errors beside those of the recording and its case: conflict where bone was removed by decay, or by another
/// physics, or is more than a browser holds, or where the recording holds none to compare with;
/// invalid_input for missing ticks.
twin::Bytes causes_of(const record::Recording& recording, const case_::Case& start, CauseUse use,
                      const Progress& progress);

/// A form of export_formats().
void write_causes(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress);

/// A form of export_formats(): one page that shows a session anywhere, without a server: its picture at every
/// moment, computed from its causes, its score, course and maps. Errors also: not_found where the page is not
/// built; those of causes_of().
void write_review_file(const ExportRequest& request, const std::filesystem::path& out,
                       const Progress& progress);

}  // namespace ream::session
