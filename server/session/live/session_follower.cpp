#include "session/live/session_follower.hpp"

#include <chrono>

#include "case/two_plates.hpp"
#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/signal_handlers.hpp"
#include "session/live/stream_messages.hpp"

namespace ream::session {
namespace {

constexpr auto follower_period = std::chrono::milliseconds(5);
/// A session that rests tells its viewers so this often, so that a silent link is a broken one.
constexpr int64_t heartbeat_ns = 500'000'000;
/// A loop that stands still for longer than this will not come back: its session ends without it.
constexpr int64_t max_standstill_ns = 1'000'000'000;

SessionState end_state(sim::LoopEnd end) {
  if (end == sim::LoopEnd::finished) return SessionState::finished;
  return end == sim::LoopEnd::stopped ? SessionState::stopped : SessionState::fault;
}

}  // namespace

SessionFollower::SessionFollower(const Simulation& simulation, LoopRings& rings, sim::HapticLoop& loop,
                                 device::DevicePort* device_port, stream::Fanout& fanout, LiveState& state,
                                 const score::MetricsAccumulator& metrics,
                                 const std::vector<uint8_t>* start_coverage)
    : id_(state.labels().id),
      simulation_(simulation),
      rings_(rings),
      loop_(loop),
      device_port_(device_port),
      state_(state),
      publisher_(simulation.bone_case.bone, fanout,
                 {.with_classes = !case_::is_two_plates(simulation.bone_case.id)}, start_coverage),
      batcher_(fanout),
      live_score_(simulation.native, simulation.model.world_from_plan),
      status_(state.status()) {
  sample_.tick = status_.tick;
  sample_.world_from_tool = sample_.world_from_handle =
      simulation.model.world_from_plan * Pose{Mat3::Identity(), simulation.script.hand.start_mm};
  status_.duration_s = metrics.duration_s();
  state_.publish(status_, metrics_json(metrics));
  publisher_.publish_all();
  thread_ = start_thread([this] { run(); });
}

SessionFollower::~SessionFollower() {
  stopping_ = true;
  thread_.join();
}

void SessionFollower::begin(std::unique_ptr<SessionFiles> files,
                            std::unique_ptr<sim::CpuAllocator::Reservation> cpu_reservation) {
  files_ = std::move(files);
  cpu_reservation_ = std::move(cpu_reservation);
  status_.state = SessionState::running;
  state_.begin();
}

/// Whatever goes wrong in the follower ends this session, not the server.
void SessionFollower::run() {
  try {
    follow();
  } catch (...) {
    loop_.request_stop();
    log::current_exception(("session " + id_ + ": its follower failed").c_str());
    if (files_) files_->write_black_box(recent_, sample_.tick);
    files_.reset();
    cpu_reservation_.reset();
    state_.end_as_fault();
  }
}

void SessionFollower::follow() {
  int64_t last_published_ns = 0;
  while (!stopping_) {
    follow_once();
    state_.give_coverage(publisher_.replica().coverage());
    publisher_.poll(steady_ns());
    const int64_t now_ns = steady_ns();
    const SessionState state = state_.status().state;
    if (state != SessionState::running && now_ns - last_published_ns > heartbeat_ns) {
      publish_state(state);
      last_published_ns = now_ns;
    }
    batcher_.publish_if_due(now_ns);
    std::this_thread::sleep_for(follower_period);
  }
}

/// Takes what the loop has done, while there is a recording to put it in.
void SessionFollower::follow_once() {
  const bool loop_ended = loop_.ended();  // read before draining: then nothing can be missed
  const std::optional<LiveState::Requests> requests = state_.take_requests(loop_ended);
  if (!requests) return;
  try {
    if (requests->labels) files_->relabel(*requests->labels);
    for (const record::ops::Annotation& annotation : requests->annotations) files_->add(annotation);
    drain_rings(loop_ended);
    if (requests->start_failure) throw Error(ErrorKind::unavailable, requests->start_failure->fault);
    if (loop_ended)
      finish();
    else if (loop_.stood_still_ms() > 0)
      note_standstill();
  } catch (const std::exception& e) {
    if (!files_) throw;  // it had ended
    end_with_fault(e.what(), requests->start_failure);
  }
}

void SessionFollower::drain_rings(bool loop_ended) {
  const int64_t now_ns = steady_ns();
  const auto take_brick = [&](const voxel::BrickImage& image) {
    files_->add(image);  // before the replica has it: the recorder reads there what the brick was
    publisher_.take(image, now_ns);
  };
  bool any = false;
  const auto take_report = [&](const record::TickReport& report) {
    any = true;
    recent_.remember(report);
    const record::TickReport kept = files_->add(report);
    update_sample(kept, sample_);
    if (case_::is_two_plates(simulation_.bone_case.id)) hide_material(sample_);
    sample_.state = kept.paused ? SessionState::paused : SessionState::running;
    batcher_.add(sample_);
    note_events(report);
  };
  if (loop_ended)
    rings_.drain_rest(simulation_.bone_case.bone, simulation_.state.tick - 1, take_brick, take_report);
  else
    rings_.drain(take_brick, take_report);
  if (const std::string failure = files_->recorder().failure(); !failure.empty())
    throw Error(ErrorKind::io, "the recording failed and the session ended: " + failure);
  if (any) note_progress();
}

void SessionFollower::note_events(const record::TickReport& report) {
  for (const record::ops::Event& event : files_->newest_events()) {
    log::info("session " + id_ + ", tick " + std::to_string(event.tick) + ": " + event.words);
    if (event.kind == "device_lost") files_->write_black_box(recent_, sample_.tick);
  }
  link_ = report.link;
  held_ = report.held;
  if (files_->events().device_is_lost() == device_lost_) return;
  device_lost_ = !device_lost_;
  report_fault(files_->events().device_words());
}

void SessionFollower::note_progress() {
  const score::MetricsAccumulator& metrics = files_->metrics();
  const int64_t now_ns = steady_ns();
  live_score_.update(metrics, {simulation_.bone_case.bone.grid, coverage()}, now_ns);
  const sim::LoopHealth health = loop_.health();
  update_sample(metrics, live_score_.depth_mm(), health, sample_);
  if (health.failed_over_tick >= 0 && !failover_reported_) {
    failover_reported_ = true;
    log::warn("session " + id_ + ": " + sim::failover_message(health.failed_over_tick));
    files_->write_black_box(recent_, sample_.tick);
    files_->note_failover(health.failed_over_tick);
  }
  cpu_reservation_->measured(health.tick_us.p99_us, health.tick, health.missed);
  nlohmann::json new_metrics;
  if (now_ns >= metrics_due_ns_ || held_ != status_.held) {  // who asked for a pause sees what it left
    metrics_due_ns_ = now_ns + score::LiveScore::publish_period_ns;
    new_metrics = metrics_json(metrics);
  }
  status_.tick = sample_.tick + 1;
  status_.duration_s = metrics.duration_s();
  status_.loop = health;
  status_.state = sample_.state == SessionState::paused ? SessionState::paused : SessionState::running;
  status_.held = held_;
  note_device_link();
  state_.publish(status_, std::move(new_metrics));
}

nlohmann::json SessionFollower::metrics_json(const score::MetricsAccumulator& metrics) const {
  return score::session_metrics_json(metrics, live_score_.results(), status_.force_scale, nullptr);
}

void SessionFollower::note_device_link() {
  DeviceLinkStatus& device = status_.device;
  device.state = device::to_text(link_);
  if (!simulation_.link) return;
  const device::RemoteLink& link = *simulation_.link;
  const int64_t rtt_us = link.rtt_us;
  device.rtt_ms = rtt_us < 0 ? std::nullopt : std::optional(1.0e-3 * static_cast<double>(rtt_us));
  device.received = link.received;
  device.missing = link.missing;
  device.late = link.late;
  device.refused = link.refused;
  publish_to_device_port();
}

/// The loop's thread is dead, stuck or very late; the guard has left the device without force. A late one
/// ends by itself when it is back.
void SessionFollower::note_standstill() {
  const std::string words = fault_message(sim::LoopEnd::stood_still);
  const int64_t now_ns = steady_ns();
  if (standstill_since_ns_ == 0) {
    standstill_since_ns_ = now_ns;
    log::error("session " + id_ + ": " + words);
    files_->write_black_box(recent_, sample_.tick);
    report_fault(words);
    batcher_.add(sample_);
    batcher_.flush();
  }
  if (now_ns - standstill_since_ns_ > max_standstill_ns) throw Error(ErrorKind::unavailable, words);
}

std::string SessionFollower::fault_message(sim::LoopEnd end) const {
  if (end != sim::LoopEnd::stood_still) return message_of(end);
  return "The haptic loop stopped for " + std::to_string(loop_.stood_still_ms()) +
         " ms; force off. Start a new session, on a computer with less to do.";
}

/// To REST, and to viewers from the next sample on; empty: there is none any more.
void SessionFollower::report_fault(const std::string& words) {
  sample_.set_fault(words);
  status_.fault = words;
  state_.publish(status_);
}

void SessionFollower::publish_state(SessionState state) {
  sample_.state = state;
  publish_to_device_port();
  if (!is_live(state)) sample_.spindle_on = false;
  sample_.set_fault(state_.status().fault);
  batcher_.add(sample_);
  batcher_.flush();
}

void SessionFollower::publish_to_device_port() {
  if (device_port_ != nullptr) device_port_->set_state(sample_.state);
}

void SessionFollower::finish() {
  const sim::LoopHealth health = loop_.health();
  const SessionState state = end_state(health.end);
  const std::string fault = fault_message(health.end);
  if (!fault.empty()) files_->write_black_box(loop_.black_box(), sample_.tick);
  publisher_.flush(steady_ns());
  note_progress();
  end(state, fault, files_->finish(health, {state, fault, status_.tick}).metrics);
}

/// What was recorded up to here is closed as a fault, or, where it never went on, as what it was before; on a
/// disk that takes nothing more, the next start of the server does so.
void SessionFollower::end_with_fault(const std::string& words,
                                     const std::optional<LiveState::StartFailure>& start_failure) {
  log::error("session " + id_ + ": " + words);
  loop_.request_stop();
  const std::vector<record::ops::Annotation> accepted = state_.close();
  if (!start_failure) files_->write_black_box(recent_, sample_.tick);
  const SessionState state = start_failure ? start_failure->state : SessionState::fault;
  nlohmann::json metrics = state_.metrics();
  try {
    metrics = files_->abandon_session(state, words, accepted);
  } catch (const std::exception& e) {
    log::error("session " + id_ +
               " could not be closed; the next start of the server tries again: " + e.what());
  }
  end(state, words, std::move(metrics));
}

void SessionFollower::end(SessionState state, const std::string& fault, nlohmann::json metrics) {
  status_.state = state;
  status_.fault = fault;
  status_.held = false;
  sample_.state = state;
  publish_to_device_port();  // before anybody who waits for the end goes on
  files_.reset();
  cpu_reservation_.reset();
  state_.end(status_, std::move(metrics));
  publish_state(state);
}

}  // namespace ream::session
