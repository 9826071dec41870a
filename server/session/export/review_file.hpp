#pragma once
#include "session/export/export_formats.hpp"
#include "twin/part_file.hpp"

namespace ream::session {

/// Beside its causes a review file holds a file of parts (twin/part_file.hpp) with these bytes first:
///   facts    JSON: `session` (what a review shows of it), `score` (Score of openapi.yaml), `marks`, `ticks`, `trace` (CSV
///            of t_s, thrust_n and spindle_on), and `map` (what a byte of a map means)
///   message  u32 ticks that have passed, then a message of proto/stream.fbs that holds from there on
///   map      u8 0 plan, 1 implant, 2 wall; then a byte for each vertex of the surface that the causes leave
enum class ReviewPart : uint8_t { facts = 1, message = 2, map = 3 };

inline constexpr twin::FileMagic review_magic{'r', 'e', 'a', 'm', 'v', 'i', 'e', 'w'};
inline constexpr uint32_t review_revision = 1;

/// A form of export_formats(): one page that shows a session anywhere, without a server: its picture at every
/// moment, computed from its causes, its score, course and maps. Errors also: not_found where the page is not
/// built; those of causes_of().
void write_review_file(const ExportRequest& request, const std::filesystem::path& out,
                       const Progress& progress);

}  // namespace ream::session
