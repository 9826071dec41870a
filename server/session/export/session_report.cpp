#include "session/export/session_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "score/rubric_store.hpp"
#include "session/export/reamed_bone.hpp"
#include "session/export/session_facts.hpp"
#include "session/folder/session_labels.hpp"
#include "session/scoring/ended_sessions.hpp"
#include "session/scoring/rescoring.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"

namespace ream::session {
namespace {

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
score::LearningCurve learning_up_to(const nlohmann::json& session, const ExportRequest& request,
                                    const score::Rubric& rubric) {
  const std::string trainee = trainee_of(session), id = session.value("id", "");
  std::vector<EndedSession> theirs = sessions_of_trainee(ended_sessions(request.data), trainee);
  const auto here =
      std::find_if(theirs.begin(), theirs.end(), [&](const EndedSession& each) { return each.id == id; });
  if (here == theirs.end()) return {};
  theirs.erase(here + 1, theirs.end());
  return learning_of(theirs, rubric, {});
}

void put_pictures(const record::Recording& recording, const score::MetricsAccumulator& ticks,
                  const ExportRequest& request, report::Material& material) {
  try {
    material.pictures =
        report::session_pictures(reamed_bone(recording, ticks, request.case_name, request.data).bone);
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::cancelled || e.kind() == ErrorKind::io) throw;
    material.why_no_pictures = std::string("There are no pictures: ") + e.what() + ".";
  }
}

}  // namespace

report::Report session_report(const ExportRequest& request, const Progress& progress) {
  const record::Recording recording = recording_of(request);
  report::Material material;
  material.rubric =
      request.rubric ? *request.rubric : score::RubricStore(rubrics_folder(request.data)).get("standard");
  material.benchmark = request.benchmark;
  material.metrics =
      Rescorer(request.data, request.case_name).metrics(recording, part_of(progress, 0.0, 0.3));
  material.score = score::apply_rubric(material.rubric, material.metrics);
  nlohmann::json session = description_of(recording);
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
  put_pictures(recording, course.ticks, request, material);
  progress(0.95, "laying out");
  return report::make_report(material);
}

}  // namespace ream::session
