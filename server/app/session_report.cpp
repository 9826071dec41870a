#include "app/session_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/data_folder.hpp"
#include "app/kept_sessions.hpp"
#include "app/reamed_bone.hpp"
#include "app/recorded_rig.hpp"
#include "app/recorded_session.hpp"
#include "app/session_facts.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "score/rubric_shelf.hpp"
#include "sim/model.hpp"

namespace ream::app {
namespace {

report::TraceSummary trace_of(const record::Recording& recording, const case_::Plan& plan) {
  report::TraceSummary trace(recording.tick_count(), sim::world_from_plan(plan).inverse());
  const voxel::VoxelGrid grid = recording.grid();
  recording.for_each_tick(0, UINT32_MAX, [&](const record::ops::Tick& tick) {
    trace.add(record::report_of(tick, grid.world_from_grid));
  });
  return trace;
}

/// The trainee's sessions up to this one.
score::LearningCurve learning_up_to(const nlohmann::json& session, const ReportRequest& request,
                                    const score::Rubric& rubric) {
  const std::string trainee = trainee_of(session), id = session.value("id", "");
  std::vector<KeptSession> theirs = sessions_of_trainee(kept_sessions(request.data), trainee);
  const auto here =
      std::find_if(theirs.begin(), theirs.end(), [&](const KeptSession& each) { return each.id == id; });
  if (here == theirs.end()) return {};
  theirs.erase(here + 1, theirs.end());
  return learning_of(theirs, rubric, {});
}

void put_pictures(const record::Recording& recording, const ReportRequest& request,
                  report::Material& material) {
  if (!request.with_pictures) {
    material.why_no_pictures = "This report was made without pictures.";
    return;
  }
  try {
    material.pictures = report::session_pictures(
        reamed_bone(recording, recorded_case(recording, request.case_name, request.data)));
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::cancelled || e.kind() == ErrorKind::io) throw;
    material.why_no_pictures = std::string("There are no pictures: ") + e.what() + ".";
  }
}

}  // namespace

report::Report session_report(const ReportRequest& request, const Progress& progress) {
  const record::Recording recording(request.recording, record::Recording::Trust::checked);
  if (const std::string& damage = recording.log().damage(); !damage.empty()) log::warn(damage);
  const score::RubricShelf shelf(rubrics_folder(request.data));
  report::Material material;
  material.rubric = score::find_rubric(request.rubric, shelf);
  if (!request.benchmark.empty()) material.benchmark = score::load_benchmark(request.benchmark);
  progress(0.05, "measuring");
  material.metrics = rescored_json(recording);
  material.score = score::apply_rubric(material.rubric, material.metrics);
  const nlohmann::json session = description_of(recording);
  material.session = session_facts(recording, session, material.metrics);
  const case_::Plan plan = recorded_plan(recording);
  material.plan_words = plan_in_words(plan);
  material.planned_depth_mm = plan.depth_mm;
  progress(0.3, "reading the course");
  material.trace = trace_of(recording, plan);
  material.remarks = remarks_of(recording);
  material.learning = learning_up_to(session, request, material.rubric);
  progress(0.5, "drawing");
  put_pictures(recording, request, material);
  progress(0.95, "laying out");
  return report::make_report(material);
}

}  // namespace ream::app
