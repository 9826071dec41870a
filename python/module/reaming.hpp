#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/progress.hpp"
#include "module/cause_log.hpp"
#include "module/own_feed_model.hpp"
#include "module/voxel_picture.hpp"
#include "record/recording.hpp"
#include "score/metrics.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/model.hpp"
#include "sim/state.hpp"
#include "sim/watchdogs.hpp"

namespace ream::python {

/// What a session is made of, as Python asks for it.
struct ReamingRequest {
  session::RunRequest run;
  std::filesystem::path data;
};

/// A moment of a Reaming: what a tick leaves to the next, and what has gone of the bone.
struct Snapshot {
  std::shared_ptr<const sim::Model> model;  ///< whose moment it is
  sim::Moment moment;
  score::MetricsAccumulator metrics;
  std::vector<uint32_t> bricks;    ///< that differ from the start
  std::vector<uint8_t> coverages;  ///< theirs, voxel::brick_voxels each
  CauseLog causes;

  size_t bytes() const;
};

/// A session that its caller steps: the program's own tick, without a clock, a thread or files. Used by one
/// thread at a time.
class Reaming {
 public:
  /// Errors: those of build_setup and make_model; usage for a device of admittance, which gives its own pose.
  explicit Reaming(ReamingRequest request);
  Reaming(const Reaming&) = delete;
  Reaming& operator=(const Reaming&) = delete;

  /// Reams by it from the next tick on, in place of the feed model that was asked for.
  void use(std::unique_ptr<OwnFeedModel> feed);

  /// Back to before the first tick. Whatever goes wrong in it, only another reset() or restore() goes on.
  void reset();
  /// One tick with the handle at a pose, plan frame; the first one also puts the reamer there. Errors:
  /// invalid_input for a first pose in which the reamer lies in bone, which is as if nothing had been asked;
  /// invalid_input for a number that is not finite, unavailable when OpenCL failed, and what a feed model in
  /// Python raised: conflict from then on, until reset() or restore().
  record::ops::Tick step(const Pose& plan_from_handle, bool spindle_on, const device::DriveControls& drive);
  /// Error invalid_input unless step() can take it.
  void require_in_reach(const Pose& plan_from_handle) const;
  /// One tick in which the script's hand holds the handle; empty at the script's end. It begins with tick 0:
  /// error conflict after a step by pose or a restored snapshot. Otherwise as step().
  std::optional<record::ops::Tick> step_script();

  /// Error conflict after a fault.
  Snapshot snapshot() const;
  /// The script's hand does not go back, but for a snapshot of before the first tick. Error conflict for a
  /// snapshot of another Reaming. What else goes wrong: as reset().
  void restore(const Snapshot& snapshot);

  /// What is scored, so far: as metrics.json. Takes some hundredths of a second.
  nlohmann::json metrics() const;
  /// What metrics() are worth by a rubric (a file, or "id" or "id@version" of the data folder), as
  /// score::score_json has it. Errors: not_found, invalid_input.
  nlohmann::json score(const std::string& rubric) const;

  /// Writes the session so far as `ream simulate` would have, into a folder that must be new or empty: it is
  /// computed once more from what the hand did, by the program's own loop. With snapshot.png and reamed.ply
  /// where there are to be `pictures`. Errors: conflict before the first tick, and for a case that has
  /// changed since; io; those of build_setup; those of `progress`.
  void save(const std::filesystem::path& folder, bool pictures, const Progress& progress) const;

  /// What a camera sees now of bone and reamer. `camera`: plan frame; empty: in front of the glenoid,
  /// superior up. Error invalid_input for cameras and sizes that cannot be.
  VoxelPicture picture(const std::optional<render::Camera>& camera, int width, int height,
                       bool with_reamer) const;

  const sim::Model& model() const { return *model_; }
  const sim::State& state() const { return *state_; }
  const case_::Case& bone_case() const { return setup_.bone_case; }
  const device::Script& script() const { return setup_.script; }

 private:
  /// Who moves the handle.
  enum class Hand { nobody_yet, script, caller, let_go };

  void begin();
  void make_state(const sim::Moment* from);
  void require_no_fault() const;
  record::ops::Tick tick(device::DeviceInput input);

  std::filesystem::path data_;
  session::SimulationSetup setup_;
  std::shared_ptr<sim::Model> model_;
  std::vector<uint8_t> start_coverage_;
  std::unique_ptr<sim::State> state_;
  std::optional<score::MetricsAccumulator> metrics_;
  std::optional<sim::PoseWatchdog> watchdog_;
  OwnFeedModel* own_feed_ = nullptr;  ///< the model's, where it has one
  device::DeviceInput input_;         ///< the last
  CauseLog causes_;                   ///< since tick 0
  Hand hand_ = Hand::nobody_yet;
};

}  // namespace ream::python
