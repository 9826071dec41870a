#include "session/replay/verify_replay.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/interrupt.hpp"
#include "core/json.hpp"
#include "record/replay_device.hpp"
#include "record/tick_report.hpp"
#include "session/simulation/recording_header.hpp"
#include "sim/step.hpp"

namespace ream::session {
namespace {

using record::Difference;

constexpr uint32_t ticks_between_looks_for_interrupts = 1000;

/// Hash of a table as the header has it; empty when it had none.
std::string recorded_table(const record::Recording& recording, const char* name) {
  const nlohmann::json tables = parse_json_or_discard(recording.header().tables);
  return tables.is_object() && tables.contains(name) && tables.at(name).is_string()
             ? tables.at(name).get<std::string>()
             : "";
}

/// Computes a recording again, tick by tick.
class Verifier {
 public:
  Verifier(const record::Recording& recording, case_::Case bone_case, const VerifyRequest& request)
      : recording_(recording), bone_case_(std::move(bone_case)), request_(request) {
    for (const record::ops::Checkpoint& c : recording.checkpoints())
      if (c.tick < last_tick()) checkpoints_.push_back(c);
    settle_vibration();
  }

  VerifyResult run() {
    const auto& segments = recording_.segments();
    for (size_t i = 0; i < segments.size() && !result_.difference; ++i) {
      const uint32_t end = i + 1 < segments.size() ? segments[i + 1].first_tick : recording_.tick_count();
      if (segments[i].first_tick >= last_tick() && i > 0) break;
      run_segment(segments[i], std::min(end, last_tick()));
    }
    if (simulation_) result_.grid_hash = simulation_->bone_case.bone.coverage_hash();
    return result_;
  }

 private:
  uint32_t last_tick() const { return std::min(request_.until_tick, recording_.tick_count()); }

  /// Vibration decides nothing, so what cannot be made as it was is left out.
  void settle_vibration() {
    force::VibrationSettings& vibration = vibration_;
    const sim::Settings settings = recorded_settings(recording_, request_.backend);
    vibration = settings.vibration;
    if (vibration.source == force::VibrationSource::off) return;
    std::string reason;
    try {
      tracks_ = force::make_vibration_tracks(vibration, settings.random_seed);
      if (to_hex(tracks_->hash()) == recorded_table(recording_, "vibration")) return;
      reason = "it is not what was recorded with";
    } catch (const Error& e) {
      reason = e.what();
    }
    vibration.source = force::VibrationSource::off;
    columns_ = record::Columns::without_vibration;
    result_.left_out.push_back("vibration and the hand force with it were not compared: " + reason);
  }

  /// The simulation of a segment on the bone as it now is.
  void make_simulation(const record::ops::Segment& segment) {
    sim::ResumeState from;
    if (simulation_) {
      from = {simulation_->state.tick, simulation_->state.session_hash};
      bone_case_ = std::move(simulation_->bone_case);
      simulation_.reset();
    }
    SimulationSetup parts =
        recorded_setup(recording_, segment, std::move(bone_case_), from, request_.backend);
    parts.settings.vibration = vibration_;
    simulation_ = std::make_unique<Simulation>(std::move(parts));
    simulation_->state.handle_given = true;
    result_.backend = simulation_->state.backend.name;
  }

  void compare_start(const record::ops::Segment& segment) {
    if (segment.first_tick != simulation_->state.tick) {
      differ({"order", "segment.first_tick", std::to_string(segment.first_tick),
              std::to_string(simulation_->state.tick)});
      return;
    }
    if (segment.first_tick > 0) return;
    // The header's tables are those of the first reamer.
    if (const std::string feed = recorded_table(recording_, "feed"), found = feed_table(); feed != found)
      differ({"table", "feed", feed, found});
    const uint64_t hash = simulation_->bone_case.bone.coverage_hash();
    if (hash != recording_.header().start_grid_hash)
      differ({"bone", "start_grid_hash", to_hex(recording_.header().start_grid_hash), to_hex(hash)});
  }

  std::string feed_table() const {
    const uint64_t hash = simulation_->model.feed->table_hash();
    return hash == 0 ? "" : to_hex(hash);
  }

  void run_segment(const record::ops::Segment& segment, uint32_t end) {
    make_simulation(segment);
    compare_start(segment);
    if (result_.difference) return;
    // A difference ends the work between batches.
    for (uint32_t first = segment.first_tick; first < end && !result_.difference;
         first += ticks_between_looks_for_interrupts) {
      throw_if_interrupted();
      request_.progress(static_cast<double>(first) / std::max(last_tick(), 1u), "computing again");
      recording_.for_each_tick(first, std::min(end, first + ticks_between_looks_for_interrupts),
                               [&](const record::ops::Tick& tick) {
                                 if (!result_.difference) repeat(tick);
                               });
    }
    if (result_.difference || result_.ticks == end) return;
    throw Error(ErrorKind::invalid_input, recording_.log().path().string() + " lacks ticks from " +
                                              std::to_string(result_.ticks) + " to " +
                                              std::to_string(end - 1));
  }

  void repeat(const record::ops::Tick& recorded) {
    sim::State& state = simulation_->state;
    if ((recorded.flags & record::failed_over_flag) != 0 && state.failed_over_tick < 0)
      state.failed_over_tick = recorded.tick;
    record::TickReport report;
    const sim::StepStatus status = sim::step(simulation_->model, state, record::input_of(recorded), report);
    if (status != sim::StepStatus::ok) {
      differ(
          {"fault", "step", "a whole tick",
           status == sim::StepStatus::not_finite ? "a number that is not finite" : "a failed OpenCL device"});
      return;
    }
    result_.session_hash = state.session_hash;
    if (auto difference = record::first_difference(recorded, record::tick_op(report), columns_))
      differ(*difference);
    else
      compare_checkpoint(recorded.tick);
    if (!result_.difference) ++result_.ticks;
  }

  void compare_checkpoint(uint32_t tick) {
    while (next_checkpoint_ < checkpoints_.size() && checkpoints_[next_checkpoint_].tick < tick)
      ++next_checkpoint_;
    if (next_checkpoint_ == checkpoints_.size() || checkpoints_[next_checkpoint_].tick != tick) return;
    const record::ops::Checkpoint& checkpoint = checkpoints_[next_checkpoint_];
    if (checkpoint.session_hash != result_.session_hash) {
      differ({"checkpoint", "session_hash", to_hex(checkpoint.session_hash), to_hex(result_.session_hash)});
      return;
    }
    const bool last = next_checkpoint_ + 1 == checkpoints_.size();
    if (!last && tick < grid_compared_tick_ + request_.ticks_between_grid_hashes) return;
    grid_compared_tick_ = tick;
    result_.grid_hash = simulation_->bone_case.bone.coverage_hash();
    if (checkpoint.grid_hash != result_.grid_hash)
      differ({"bone", "grid_hash", to_hex(checkpoint.grid_hash), to_hex(result_.grid_hash)});
  }

  void differ(const Difference& difference) {
    if (!result_.difference) result_.difference = difference;
  }

  const record::Recording& recording_;
  case_::Case bone_case_;
  const VerifyRequest request_;
  force::VibrationSettings vibration_;
  std::shared_ptr<const force::VibrationTracks> tracks_;  ///< kept, as they are shared by who needs them
  record::Columns columns_ = record::Columns::all;
  std::vector<record::ops::Checkpoint> checkpoints_;
  size_t next_checkpoint_ = 0;
  uint32_t grid_compared_tick_ = 0;
  std::unique_ptr<Simulation> simulation_;
  VerifyResult result_;
};

}  // namespace

VerifyResult verify_replay(const record::Recording& recording, case_::Case bone_case,
                           const VerifyRequest& request) {
  return Verifier(recording, std::move(bone_case), request).run();
}

std::string difference_words(uint32_t tick, const Difference& difference) {
  char time[32];
  std::snprintf(time, sizeof time, "%.3f", tick * tick_s);
  return "tick " + std::to_string(tick) + " (" + time + " s) differs in " + difference.kind + ": " +
         difference.field + " is " + difference.found + ", recorded " + difference.recorded;
}

}  // namespace ream::session
