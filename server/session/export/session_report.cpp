#include "session/export/session_report.hpp"

#include <algorithm>

#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "core/log.hpp"
#include "core/version.hpp"
#include "report/number_text.hpp"
#include "score/rubric_store.hpp"
#include "session/export/reamed_bone.hpp"
#include "session/folder/session_labels.hpp"
#include "session/load/component_load.hpp"
#include "session/scoring/ended_sessions.hpp"
#include "session/scoring/rescoring.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"

namespace ream::session {
using nlohmann::json;
namespace {

std::string text(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

json parsed_or_empty(const std::string& words) {
  json value = parse_json_or_discard(words);
  return value.is_object() ? value : json::object();
}

std::string guide_in_words(const json& session) {
  const auto guide = session.find("guide");
  const std::string kind = guide != session.end() && guide->is_object() ? text(*guide, "kind") : "";
  if (kind == "nipple") return "nipple in the pilot hole";
  if (kind == "pin") return "guide pin";
  return kind == "none" ? "none" : "";
}

std::string device_in_words(const std::string& device) {
  if (device.empty() || device == "script") return "a script";
  if (device == "browser") return "the page";
  return device == "network" ? "a device on the network" : device;
}

/// `session`: of description_of(). A session of a study goes by its code, not by a name.
report::SessionFacts session_facts(const record::Recording& recording, const json& session,
                                   const json& metrics) {
  const record::ops::Header& header = recording.header();
  report::SessionFacts facts;
  facts.id = text(session, "id");
  facts.case_name = text(session, "case_name");
  if (facts.case_name.empty()) facts.case_name = header.case_id;
  facts.side = text(session, "side");
  facts.trainee = text(session, "participant");
  facts.blinded = !facts.trainee.empty();
  if (!facts.blinded) facts.trainee = text(session, "trainee");
  facts.created_utc = text(session, "created_utc");
  if (facts.created_utc.empty() && !recording.segments().empty())
    facts.created_utc = recording.segments()[0].utc;
  facts.attempt = session.value("attempt", 1);
  facts.theatre = session.value("theatre", false);
  facts.state = recording.end() ? recording.end()->state : "not closed in order";
  facts.fault = text(session, "fault");
  facts.reamer = text(session, "tool");
  facts.device = device_in_words(text(session, "device"));
  facts.device_profile = text(session, "device_profile");
  facts.feed_model = text(session, "model");
  facts.guide = guide_in_words(session);
  facts.force_scale = header.force_scale;
  facts.build = header.build;
  facts.scored_by = version_text();
  facts.case_hash = to_hex(header.case_hash);
  facts.start_grid_hash = to_hex(header.start_grid_hash);
  facts.grid_hash = text(metrics, "grid_hash");
  facts.session_hash = text(metrics, "session_hash");
  return facts;
}

/// "2 mm deep with ellipse 18.25,9; pilot hole 6.2 mm wide, 12 mm deep; implant radius 24 mm".
std::string plan_in_words(const case_::Plan& plan) {
  std::string words = report::with_unit(plan.depth_mm, "mm") + " deep with " + plan.reamer;
  if (plan.pilot_hole)
    words += "; pilot hole " + report::shortest(plan.pilot_hole->diameter_mm) + " mm wide, " +
             report::shortest(plan.pilot_hole->depth_mm) + " mm deep";
  if (plan.implant_radius_mm)
    words += "; implant " + (plan.implant_size.empty() ? "" : plan.implant_size + ", ") + "back radius " +
             report::shortest(*plan.implant_radius_mm) + " mm";
  else if (!plan.implant_size.empty())
    words += "; implant " + plan.implant_size;
  return words;
}

std::vector<report::Remark> remarks_of(const record::Recording& recording) {
  std::vector<report::Remark> remarks;
  for (const record::ops::Annotation& op : recording.annotations())
    remarks.push_back({op.tick * tick_s, op.words, op.author});
  std::stable_sort(remarks.begin(), remarks.end(),
                   [](const report::Remark& a, const report::Remark& b) { return a.at_s < b.at_s; });
  return remarks;
}

/// What its ticks say.
struct Course {
  report::TraceSummary trace;
  score::MetricsAccumulator ticks;
};

Course course_of(const record::Recording& recording, const case_::Plan& plan) {
  const voxel::VoxelGrid grid = recording.grid();
  const Pose plan_from_world = sim::world_from_plan(plan).inverse();
  Course course{{recording.tick_count(), plan_from_world}, {grid.voxel_volume_mm3(), plan_from_world}};
  recording.for_each_tick(0, UINT32_MAX, [&](const record::ops::Tick& tick) {
    const record::TickReport report = record::report_of(tick, grid.world_from_grid);
    course.trace.add(report);
    course.ticks.add(report);
  });
  return course;
}

/// The trainee's sessions up to this one.
score::LearningCurve learning_up_to(const json& session, const ExportRequest& request,
                                    const score::Rubric& rubric) {
  const std::string trainee = trainee_of(session), id = session.value("id", "");
  std::vector<EndedSession> theirs = sessions_of_trainee(ended_sessions(request.data), trainee);
  const auto here =
      std::find_if(theirs.begin(), theirs.end(), [&](const EndedSession& each) { return each.id == id; });
  if (here == theirs.end() || here->session.value("device", "script") == "script") return {};
  theirs.erase(here + 1, theirs.end());
  return learning_of(theirs, rubric, {});
}

report::LoadMaterial load_material(const RecordedLoad& recorded, const report::ReamedBone& bone) {
  const ComponentLoad& load = recorded.load;
  report::LoadMaterial material;
  material.force_n = load.request.force_n;
  material.cell_mm = load.request.cell_mm;
  material.law = load.request.law.description();
  material.settled = load.settled();
  for (const auto& [name, words] :
       {std::pair{"before", "Before"}, {"planned", "As planned"}, {"reamed", "As reamed"}})
    if (const LoadedState* state = load.state(name))
      material.states.push_back({words, state->supported_percent, state->support_lost_percent,
                                 state->motion_um(), state->plate_strain(), state->overstrained_percent()});
  if (load.state("reamed") != nullptr)
    material.map = report::strain_picture(bone, recorded.strain_codes(bone.after.vertices_mm));
  return material;
}

/// What needs the bone: pictures, and the component under load where that is asked for.
void put_bone(const record::Recording& recording, const score::MetricsAccumulator& ticks,
              const ExportRequest& request, const Progress& progress, report::Material& material) {
  try {
    const report::ReamedBone bone = reamed_bone(recording, ticks, request.case_name, request.data).bone;
    material.pictures = report::session_pictures(bone);
    if (!request.component_load) return;
    material.load =
        load_material(load_recorded(recording, request.case_name, request.data, {}, progress), bone);
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::cancelled || e.kind() == ErrorKind::io || request.component_load) throw;
    material.why_no_pictures = std::string("There are no pictures: ") + e.what() + ".";
  }
}

}  // namespace

json description_of(const record::Recording& recording) {
  json session = parsed_or_empty(recording.header().description);
  const std::filesystem::path beside = recording.log().path().parent_path() / "session.json";
  std::error_code failed;
  if (std::filesystem::exists(beside, failed)) try {
      session.update(read_json_file(beside));
    } catch (const Error& e) {
      log::warn(e.what());
    }
  return session;
}

report::Report session_report(const ExportRequest& request, const Progress& progress) {
  const record::Recording recording = recording_of(request);
  report::Material material;
  material.rubric =
      request.rubric ? *request.rubric : score::RubricStore(rubrics_folder(request.data)).get("standard");
  material.benchmark = request.benchmark;
  material.metrics =
      Rescorer(request.data, request.case_name).metrics(recording, part_of(progress, 0.0, 0.3));
  material.score = score::apply_rubric(material.rubric, material.metrics);
  json session = description_of(recording);
  if (request.labels) write_labels(*request.labels, session);
  material.session = session_facts(recording, session, material.metrics);
  const case_::Plan plan = recorded_plan(recording);
  material.plan_words = plan_in_words(plan);
  material.planned_depth_mm = plan.depth_mm;
  progress(0.3, "reading the course");
  Course course = course_of(recording, plan);
  material.trace = std::move(course.trace);
  material.remarks = remarks_of(recording);
  material.learning = learning_up_to(session, request, material.rubric);
  progress(0.5, "drawing");
  put_bone(recording, course.ticks, request, part_of(progress, 0.5, 0.95), material);
  progress(0.95, "laying out");
  return report::make_report(material);
}

}  // namespace ream::session
