#include "module/reaming.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "device/registry/device_registry.hpp"
#include "score/bone_results.hpp"
#include "score/planned_face.hpp"
#include "score/rubric_score.hpp"
#include "score/rubric_store.hpp"
#include "session/live/headless_run.hpp"
#include "session/scoring/score_document.hpp"
#include "session/simulation/reamed_pictures.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/hand_output.hpp"
#include "sim/haptic_loop.hpp"
#include "sim/step.hpp"
#include "voxel/bricks.hpp"

namespace ream::python {
namespace {

using voxel::brick_voxels;

/// Poses are kept as whole nanometres in 32 bits.
constexpr double max_world_mm = 1900.0;

sim::LoopEnd end_of(sim::StepStatus status) {
  return status == sim::StepStatus::collision_failed ? sim::LoopEnd::collision_failed
                                                     : sim::LoopEnd::not_finite;
}

session::SimulationSetup setup_for(const ReamingRequest& request) {
  session::SimulationSetup setup = session::build_setup(request.run, request.data);
  if (setup.device->traits().causality == device::Causality::admittance)
    throw Error(ErrorKind::usage,
                "device profile '" + setup.device->traits().profile +
                    "' gives a pose and takes a force from the hand; choose one that takes a pose, "
                    "such as ideal");
  return setup;
}

}  // namespace

size_t Snapshot::bytes() const {
  return sizeof(Snapshot) + moment.schedule.bytes() + bricks.size() * sizeof(uint32_t) + coverages.size() +
         causes.bytes();
}

Reaming::Reaming(ReamingRequest request) : data_(request.data), setup_(setup_for(request)) {
  model_ = std::make_shared<sim::Model>(sim::make_model(session::plan_of(setup_.bone_case),
                                                        setup_.bone_case.bone, setup_.tool, setup_.settings));
  start_coverage_ = setup_.bone_case.bone.coverage;
  begin();
}

void Reaming::use(std::unique_ptr<OwnFeedModel> feed) {
  own_feed_ = feed.get();
  model_->feed = std::move(feed);
}

/// A device that has failed once is not asked again.
void Reaming::make_state(const sim::Moment* from) {
  voxel::BoneModel& bone = setup_.bone_case.bone;
  if (state_ && state_->failed_over_tick >= 0) model_->settings.backend = "cpu";
  state_ = from == nullptr ? std::make_unique<sim::State>(*model_, bone)
                           : std::make_unique<sim::State>(*model_, bone, *from);
  watchdog_.emplace(setup_.device->traits().stale);
  input_ = {};
}

/// Of bone that is as it was at the start.
void Reaming::begin() {
  make_state(nullptr);
  metrics_.emplace(setup_.bone_case.bone.grid.voxel_volume_mm3(), model_->world_from_plan.inverse());
  causes_ = {};
  hand_ = Hand::nobody_yet;
}

void Reaming::reset() {
  hand_ = Hand::let_go;
  // The script's hand is made anew, as it has a past of its own.
  setup_.device = device::make_device({setup_.request.device, setup_.request.device_profile, &setup_.script,
                                       model_->world_from_plan, setup_.request.random_seed, data_})
                      .device;
  setup_.bone_case.bone.coverage = start_coverage_;
  begin();
}

record::ops::Tick Reaming::tick(device::DeviceInput input) {
  watchdog_->judge(state_->tick, input);
  record::TickReport report;
  const sim::StepStatus status = sim::step(*model_, *state_, input, report);
  if (own_feed_ != nullptr && own_feed_->has_raised()) {
    hand_ = Hand::let_go;
    own_feed_->throw_raised();
  }
  if (status != sim::StepStatus::ok) {
    hand_ = Hand::let_go;
    throw Error(status == sim::StepStatus::not_finite ? ErrorKind::invalid_input : ErrorKind::unavailable,
                sim::message_of(end_of(status)));
  }
  if (hand_ == Hand::script) setup_.device->write(sim::output_of(report));
  const record::ops::Tick kept = record::tick_op(report);
  causes_.add(kept);
  metrics_->add(record::report_of(kept, setup_.bone_case.bone.grid.world_from_grid));
  return kept;
}

void Reaming::require_in_reach(const Pose& plan_from_handle) const {
  if (!(model_->world_from_plan.point(plan_from_handle.translation_mm).cwiseAbs().maxCoeff() < max_world_mm))
    throw Error(ErrorKind::invalid_input, "a pose is more than 1.9 m from the origin of the CT");
}

record::ops::Tick Reaming::step(const Pose& plan_from_handle, bool spindle_on,
                                const device::DriveControls& drive) {
  require_no_fault();
  require_in_reach(plan_from_handle);
  const bool first = hand_ == Hand::nobody_yet;
  hand_ = Hand::caller;
  input_ = {};
  input_.world_from_handle = model_->world_from_plan * plan_from_handle;
  input_.spindle_on = spindle_on;
  input_.drive = drive;
  const record::ops::Tick stepped = tick(input_);
  if (first && (stepped.flags & record::engaged_flag) != 0) {
    reset();
    throw Error(ErrorKind::invalid_input,
                "the first pose puts the reamer into the bone; begin outside of it, such as at z = -3 mm");
  }
  return stepped;
}

void Reaming::require_no_fault() const {
  if (hand_ == Hand::let_go)
    throw Error(ErrorKind::conflict, "the simulation has ended with a fault; call reset() or restore()");
}

std::optional<record::ops::Tick> Reaming::step_script() {
  require_no_fault();
  if (hand_ == Hand::caller)
    throw Error(ErrorKind::conflict,
                "the script's hand can only ream from the beginning; call reset() first");
  if (hand_ == Hand::nobody_yet) setup_.device->open();
  hand_ = Hand::script;
  setup_.device->session_paused(false);
  if (setup_.device->read(input_) != device::DeviceStatus::ok) return std::nullopt;
  return tick(input_);
}

Snapshot Reaming::snapshot() const {
  require_no_fault();
  const voxel::BoneModel& bone = setup_.bone_case.bone;
  Snapshot taken{model_, *state_, *metrics_, {}, {}, causes_};
  for (uint32_t brick = 0; brick < bone.grid.brick_count(); ++brick) {
    const size_t base = bone.grid.brick_base(brick);
    const uint8_t* now = bone.coverage.data() + base;
    if (std::equal(now, now + brick_voxels, start_coverage_.data() + base)) continue;
    taken.bricks.push_back(brick);
    taken.coverages.insert(taken.coverages.end(), now, now + brick_voxels);
  }
  return taken;
}

void Reaming::restore(const Snapshot& snapshot) {
  if (snapshot.model != model_)
    throw Error(ErrorKind::conflict, "the snapshot is of another simulation; restore it there");
  if (!snapshot.moment.started) return reset();
  hand_ = Hand::let_go;
  voxel::BoneModel& bone = setup_.bone_case.bone;
  bone.coverage = start_coverage_;
  for (size_t i = 0; i < snapshot.bricks.size(); ++i)
    voxel::write_brick(bone.grid, bone.coverage.data(), snapshot.bricks[i],
                       snapshot.coverages.data() + i * brick_voxels);
  make_state(&snapshot.moment);
  metrics_ = snapshot.metrics;
  causes_ = snapshot.causes;
  hand_ = Hand::caller;
}

nlohmann::json Reaming::metrics() const {
  const voxel::BoneModel& bone = setup_.bone_case.bone;
  const score::MetricResults of_bone =
      score::bone_results(*setup_.native, score::planned_face(*setup_.native),
                          {bone.grid, bone.coverage.data()}, metrics_->cut_line(), model_->world_from_plan);
  const uint64_t grid_hash = bone.coverage_hash();
  return score::session_metrics_json(*metrics_, of_bone, model_->settings.force_scale, &grid_hash);
}

nlohmann::json Reaming::score(const std::string& rubric) const {
  const score::Rubric judge = score::find_rubric(rubric, score::RubricStore(rubrics_folder(data_)));
  return score::score_json(judge, score::apply_rubric(judge, metrics()));
}

void Reaming::save(const std::filesystem::path& folder, bool pictures, const Progress& progress) const {
  if (causes_.size() == 0) throw Error(ErrorKind::conflict, "there is nothing to save before the first step");
  if (own_feed_ != nullptr)
    throw Error(
        ErrorKind::conflict,
        "a session with a feed model of your own cannot be saved: the program could not compute it again");
  AtomicFolder made(folder);
  session::SimulationSetup setup = setup_for({setup_.request, data_});
  setup.device = std::make_unique<record::ReplayDevice>(causes_.all(), setup.device->traits());
  session::Simulation again(std::move(setup));
  again.state.handle_given = true;
  again.state.failed_over_tick = state_->failed_over_tick;
  const std::vector<uint8_t> before = again.bone_case.bone.coverage;
  session::run_headless(again, before, made.path(), false, progress);
  if (again.state.session_hash != state_->session_hash)
    throw Error(ErrorKind::conflict, "the case '" + setup_.bone_case.id +
                                         "' has changed since the simulation was made; make it anew");
  session::keep_score(made.path(), data_);
  made.commit();
  if (pictures) session::write_reamed_pictures(again, before, folder);
}

VoxelPicture Reaming::picture(const std::optional<render::Camera>& camera, int width, int height,
                              bool with_reamer) const {
  const case_::Case& c = setup_.bone_case;
  const Pose world_from_plan = model_->world_from_plan;
  render::Camera seen_from = session::glenoid_camera(
      model_->plan, c.glenoid ? c.glenoid->superior : Vec3::UnitZ(), default_camera_distance_mm);
  if (camera) {
    seen_from = *camera;
    seen_from.eye_mm = world_from_plan.point(camera->eye_mm);
    seen_from.target_mm = world_from_plan.point(camera->target_mm);
    seen_from.up = world_from_plan.rotation * camera->up;
  }
  const Pose grid_from_world = state_->world_from_grid.inverse();
  VoxelScene scene{c.bone, start_coverage_.data()};
  if (with_reamer && state_->started) {
    scene.reamer = &setup_.tool.mesh;
    scene.grid_from_reamer = grid_from_world * state_->world_from_tool;
  }
  return draw_voxels(scene, grid_from_world, seen_from, width, height);
}

}  // namespace ream::python
