#include <algorithm>
#include <locale>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/page_folder.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "score/deviation.hpp"
#include "score/rubric_store.hpp"
#include "session/export/cause_export.hpp"
#include "session/export/reamed_bone.hpp"
#include "session/export/session_tables.hpp"
#include "session/folder/session_folder.hpp"
#include "session/replay/recorded_stream.hpp"
#include "session/scoring/rescoring.hpp"
#include "session/scoring/score_document.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "twin/part_file.hpp"

namespace ream::session {
using nlohmann::json;
namespace {

namespace fs = std::filesystem;
using twin::Bytes;

/// Parts of a review file beside its causes, by their first byte; proto/causes.md says what follows.
enum class ReviewPart : uint8_t { facts = 1, hello = 2, telemetry = 3, tool = 4, map = 5 };

constexpr twin::FileMagic review_magic{'r', 'e', 'a', 'm', 'v', 'i', 'e', 'w'};
constexpr uint32_t review_revision = 1;

/// Where a page has it, there the session goes.
constexpr std::string_view place_for_session = "<!--ream:session-->";

/// The picture moves 50 times a second.
constexpr uint32_t ticks_of_message = 20;
/// More than a timeline has pixels is seen by nobody.
constexpr uint32_t max_trace_rows = 600;

void append(Bytes& part, std::span<const std::byte> bytes) {
  part.insert(part.end(), bytes.begin(), bytes.end());
}

/// As it is kept, else by the newest standard rubric.
json score_of(const record::Recording& recording, const ExportRequest& request, const json& session,
              const Progress& progress) {
  const fs::path kept = score_json(request.recording.parent_path());
  std::error_code failed;
  const bool is_kept = fs::is_regular_file(kept, failed);
  json score = explained_score(
      is_kept ? read_json_file(kept)
              : score_document(version_text(), session,
                               Rescorer(request.data, request.case_name).metrics(recording, progress),
                               {score::RubricStore(rubrics_folder(request.data)).get("standard"), ""}));
  score["session"] = session.value("id", "");
  score["standing"] = is_kept ? "kept" : "computed";
  return score;
}

/// The columns of trace.csv that a timeline shows.
std::string trace_of(const record::Recording& recording, uint32_t ticks) {
  const voxel::VoxelGrid grid = recording.grid();
  const uint32_t stride = std::max(1u, (ticks + max_trace_rows - 1) / max_trace_rows);
  std::ostringstream csv;
  csv.imbue(std::locale::classic());
  csv << "t_s,thrust_n,spindle_on\n";
  recording.for_each_tick(0, ticks, [&](const record::ops::Tick& tick) {
    if (tick.tick % stride != 0) return;
    const record::TickReport report = record::report_of(tick, grid.world_from_grid);
    csv << tick.tick * tick_s << ',' << report.thrust_n << ',' << report.spindle_on << '\n';
  });
  return csv.str();
}

/// What a review shows of the session itself. Who takes part in a study goes by a code, not by a name.
json shown_session(const json& session, const record::Recording& recording, const fs::path& folder) {
  const auto text = [&](const char* key, const std::string& absent) {
    const auto found = session.find(key);
    return found != session.end() && found->is_string() ? found->get<std::string>() : absent;
  };
  const std::string participant = text("participant", "");
  return {{"id", text("id", folder.filename().string())},
          {"title", text("title", "")},
          {"trainee", participant.empty() ? text("trainee", "") : ""},
          {"participant", participant},
          {"attempt", session.value("attempt", 1)},
          {"theatre", session.value("theatre", false)},
          {"case", text("case", recording.header().case_id)},
          {"created_utc", text("created_utc", "")},
          {"device", text("device", "script")},
          {"state", recording.end() ? recording.end()->state : "interrupted"},
          {"fault", text("fault", "")}};
}

/// What of the recording the file leaves out, in words; empty: nothing.
std::string warning_of(const record::Recording& recording, uint32_t ticks) {
  if (ticks == recording.tick_count()) return "";
  return "the program was ended; no bone was saved for the last " +
         std::to_string(recording.tick_count() - ticks) + " ms";
}

json facts_of(const record::Recording& recording, const ExportRequest& request, uint32_t ticks,
              const Progress& progress) {
  const json session = labelled_session(request, recording);
  json marks = json::array();
  for (const ReplayMark& mark : recorded_marks(recording))
    if (mark.at_s <= ticks * tick_s)
      marks.push_back({{"at_s", mark.at_s}, {"kind", mark.kind}, {"words", mark.words}});
  json score = score_of(recording, request, session, progress);
  return {{"program", version_text()},
          {"session", shown_session(session, recording, fs::absolute(request.recording).parent_path())},
          {"score", std::move(score)},
          {"marks", std::move(marks)},
          {"ticks", ticks},
          {"trace", trace_of(recording, ticks)},
          {"warning", warning_of(recording, ticks)},
          {"map",
           {{"step_mm", score::deviation_step_mm},
            {"range_mm", score::deviation_range_mm},
            {"wall_step_mm", score::wall_step_mm},
            {"wall_range_mm", 127.0 * score::wall_step_mm},
            {"unknown", score::deviation_unknown}}}};
}

void add_stream(const record::Recording& recording, const case_::Case& start,
                const std::shared_ptr<const score::NativeGlenoid>& native, const std::string& id,
                uint32_t ticks, twin::PartFileWriter& file, const Progress& progress) {
  stream::HelloInfo hello = recorded_hello(recording, start);
  hello.session_id = hello.replay_of = id;
  const auto take = [&](RecordedMessage kind, uint32_t at_ticks, const stream::Message& message) {
    const bool is_hello = kind == RecordedMessage::hello;
    Bytes part{static_cast<std::byte>(is_hello                        ? ReviewPart::hello
                                      : kind == RecordedMessage::tool ? ReviewPart::tool
                                                                      : ReviewPart::telemetry)};
    if (!is_hello) record::ops::put_field(part, at_ticks);
    append(part, *message);
    file.add(part);
  };
  recorded_stream(recording, start, native, std::move(hello), ticks, ticks_of_message, take, progress);
}

/// In the order of the vertices of the surface that the causes leave.
void add_maps(const record::Recording& recording, const ExportRequest& request, twin::PartFileWriter& file,
              const Progress& progress) {
  const report::ReamedBone bone =
      reamed_bone(recording, accumulated(recording, progress), request.case_name, request.data).bone;
  uint8_t which = 0;
  for (const std::vector<int8_t>* map : {&bone.from_plan, &bone.from_implant, &bone.wall}) {
    Bytes part{static_cast<std::byte>(ReviewPart::map), static_cast<std::byte>(which++)};
    append(part, std::as_bytes(std::span(*map)));
    if (!map->empty()) file.add(part);
  }
}

/// A page's element that holds bytes.
std::string element(const std::string& id, std::span<const std::byte> bytes) {
  return "<script type=\"application/octet-stream\" id=\"" + id + "\">" + base64(bytes) + "</script>\n";
}

}  // namespace

void write_review_file(const ExportRequest& request, const fs::path& out, const Progress& progress) {
  const fs::path folder = page_folder(request.page);
  const fs::path page_file = folder / "review_file.html";
  std::error_code failed;
  if (folder.empty() || !fs::is_regular_file(page_file, failed))
    throw Error(ErrorKind::not_found,
                "a review file needs the page, which is not built (scripts/build makes it)");
  const std::string page = read_text_file(page_file);
  const size_t place = page.find(place_for_session);
  if (place == std::string::npos)
    throw Error(ErrorKind::invalid_input,
                page_file.string() + " has no place for a session; build the page again");
  progress(0.0, "reading the case");
  const record::Recording recording = recording_of(request);
  case_::Case native_case = recorded_case(recording, request.case_name, request.data);
  const auto native = glenoid_if_known(recording, native_case, request.case_name, request.data);
  const case_::Case start = as_before_tick_0(recording, std::move(native_case));
  const uint32_t ticks = whole_ticks(recording);
  const Bytes causes = causes_of(recording, start, CauseUse::pictures, part_of(progress, 0.1, 0.4));
  twin::PartFileWriter review(review_magic, review_revision);
  const json facts = facts_of(recording, request, ticks, part_of(progress, 0.4, 0.5));
  Bytes part{static_cast<std::byte>(ReviewPart::facts)};
  const std::string text = facts.dump(-1, ' ', false, json::error_handler_t::replace);
  append(part, std::as_bytes(std::span(text)));
  review.add(part);
  add_stream(recording, start, native, facts.at("session").at("id"), ticks, review,
             part_of(progress, 0.5, 0.8));
  progress(0.8, "comparing surfaces");
  // A map is of the bone at the recording's end, and needs something to compare with.
  if (native && ticks == recording.tick_count())
    add_maps(recording, request, review, part_of(progress, 0.8, 0.95));
  write_file_atomically(out, page.substr(0, place) + element("ream-causes", causes) +
                                 element("ream-review", review.finish()) +
                                 page.substr(place + place_for_session.size()));
}

}  // namespace ream::session
