#include "session/live/reaming_session.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "session/folder/session_folder.hpp"
#include "session/folder/session_labels.hpp"
#include "session/live/stream_messages.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/tick_trial.hpp"

namespace ream::session {
namespace {

constexpr auto follower_period = std::chrono::milliseconds(5);
/// A session that rests tells its viewers so this often, so that a silent link is a broken one.
constexpr int64_t heartbeat_ns = 500'000'000;

RunRequest run_request(const SessionContext& context, const SessionRequest& request) {
  RunRequest run;
  run.case_name = request.case_id;
  const bool built_in = request.script == "demo" || request.script == "practice";
  run.script_name =
      built_in ? request.script : (context.data / "scripts" / (request.script + ".json")).string();
  run.backend = context.backend;
  run.tool_spacing_mm = context.tool_spacing_mm;
  run.force_scale = request.force_scale;
  run.device = request.device;
  run.device_profile = request.device_profile;
  return run;
}

}  // namespace

ReamingSession::ReamingSession(const SessionContext& context, const SessionRequest& request)
    : ReamingSession(context, request,
                     Beginning{nullptr, false, SessionState::fault,
                               build_setup(run_request(context, request), context.data)}) {}

ReamingSession::ReamingSession(const SessionContext& context, const SessionRequest& request,
                               const std::string& reamer)
    : ReamingSession(context, request, resumed(context, request, reamer)) {}

ReamingSession::Beginning ReamingSession::resumed(const SessionContext& context,
                                                  const SessionRequest& request, const std::string& reamer) {
  Beginning beginning;
  const std::filesystem::path folder = sessions_folder(context.data) / request.id;
  beginning.from = std::make_unique<ResumePoint>(folder, context.data);
  beginning.before = read_session_folder(folder).record.status.state;
  beginning.parts = beginning.from->parts(run_request(context, request), reamer);
  beginning.changed_tool = beginning.parts.reamer.words != beginning.from->recording().segments().back().tool;
  return beginning;
}

ReamingSession::ReamingSession(const SessionContext& context, const SessionRequest& request,
                               Beginning beginning)
    : context_(context),
      request_(request),
      id_(request.id),
      folder_(sessions_folder(context.data) / id_),
      from_(std::move(beginning.from)),
      changed_tool_(beginning.changed_tool),
      state_without_start_(beginning.before),
      simulation_(std::move(beginning.parts)),
      rings_(simulation_.bone_case.bone.grid),
      rehearsed_us_(sim::rehearsed_tick_us(simulation_.model, simulation_.state)),
      loop_(simulation_.model, simulation_.state, *simulation_.device, rings_.reports,
            {true, context.realtime, -1, context.guard_now_ns}),
      port_(port_of_device()),
      fanout_(std::make_shared<stream::Fanout>()),
      publisher_(simulation_.bone_case.bone, *fanout_),
      live_score_(*simulation_.native, simulation_.model.world_from_plan),
      batcher_(*fanout_),
      crash_watch_(*simulation_.device) {
  simulation_.state.brick_sender = &rings_.sender;
  const sim::Backend& backend = simulation_.state.backend;
  log::info("session " + id_ + ": contact and removal on " + backend.name +
            (backend.choice.empty() ? "" : " (" + backend.choice + ")") + ", slow ticks take " +
            std::to_string(std::lround(rehearsed_us_)) + " us");
  labels_ = request_;
  status_.device.name = request_.device;
  status_.device.profile = simulation_.device->traits().profile;
  status_.force_scale = simulation_.model.settings.force_scale;
  score::MetricsAccumulator metrics(simulation_.bone_case.bone.grid.voxel_volume_mm3(),
                                    simulation_.model.world_from_plan.inverse());
  if (from_) {
    metrics = from_->metrics();
    status_.tick = sample_.tick = from_->ticks();
    annotations_ = from_->recording().annotations();
  }
  status_.duration_s = metrics.duration_s();
  metrics_ = score::session_metrics_json(metrics, live_score_.results(), status_.force_scale, nullptr);
  sample_.world_from_tool = sample_.world_from_handle =
      simulation_.model.world_from_plan * Pose{Mat3::Identity(), simulation_.script.hand.start_mm};
  fanout_->publish_hello(stream::hello_message(hello()));
  publisher_.publish_all();
  follower_ = std::thread([this] { follow_to_the_end(); });
}

ReamingSession::~ReamingSession() {
  stop();
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  follower_.join();
}

stream::HelloInfo ReamingSession::hello() const {
  stream::HelloInfo info = make_hello(simulation_.bone_case, simulation_.model.plan, simulation_.model.tool);
  info.session_id = id_;
  info.server_epoch = context_.server_epoch;
  info.force_scale = simulation_.model.settings.force_scale;
  info.force_max_n = simulation_.model.settings.limits.force_max_n;
  return info;
}

void ReamingSession::show() const {
  if (!context_.showcase) return;
  const case_::Case& c = simulation_.bone_case;
  const std::string words = (c.name.empty() ? c.id : c.name) + ", " + case_::to_text(c.side) + ", reamer " +
                            simulation_.model.tool.name;
  context_.showcase->set(std::make_shared<const openigtlink::SessionView>(
      openigtlink::SessionView{id_, words, c.bone.grid, simulation_.model.tool.mesh, fanout_}));
}

/// session.json beside what describes the run.
nlohmann::json ReamingSession::told_of(SessionState state, const std::string& fault) const {
  nlohmann::json told = {{"id", id_},
                         {"state", to_text(state)},
                         {"created_utc", request_.created_utc},
                         {"script", request_.script},
                         {"device", request_.device}};
  if (!fault.empty()) told["fault"] = fault;
  if (!is_live(state)) told["ticks"] = status().tick;
  const std::lock_guard lock(mutex_);
  write_labels(labels_, told);
  return told;
}

void ReamingSession::write_running(const SessionFiles& files) const {
  nlohmann::json session = files.description();
  session.update(told_of(SessionState::running, {}));
  write_file_atomically(session_json(folder_), session.dump(2) + "\n");
}

/// The recording first: what session.json calls running has one. A recording that was to go on is as it was
/// when this fails.
void ReamingSession::open_files() {
  make_writable_folder(folder_);
  lock_ = from_ ? from_->take_lock() : locked(folder_);
  const uint8_t* coverage = publisher_.replica().coverage().data();
  std::unique_ptr<SessionFiles> files;
  try {
    files =
        from_ ? std::make_unique<SessionFiles>(simulation_, folder_, coverage, *from_, changed_tool_)
              : std::make_unique<SessionFiles>(simulation_, folder_, coverage, SessionFiles::Trace::left_out);
    write_running(*files);
    std::error_code ignored;
    for (const char* result : {"reamed.ply", "snapshot.png", "deviation.json", "deviation.bin"})
      std::filesystem::remove(folder_ / result, ignored);
  } catch (const std::exception&) {
    files.reset();
    if (from_) from_->cut_to_its_end();
    throw;
  }
  const std::lock_guard lock(mutex_);
  files_ = std::move(files);
  status_.state = SessionState::running;
}

void ReamingSession::start() {
  if (status().state != SessionState::created)
    throw Error(ErrorKind::conflict, "session " + id_ + " has been started already");
  place_ = context_.places->reserve(id_, rehearsed_us_);
  try {
    open_files();
  } catch (const std::exception& e) {
    place_.reset();
    lock_.reset();
    std::error_code ignored;
    if (!from_) std::filesystem::remove_all(folder_, ignored);
    const std::lock_guard lock(mutex_);
    status_.state = SessionState::fault;
    status_.fault = e.what();
    throw;
  }
  from_.reset();
  try {
    loop_.pin_to(place_->cpu());
    loop_.start();
    show();
  } catch (const std::exception& e) {
    std::unique_lock lock(mutex_);
    start_failure_ = e.what();
    changed_.wait(lock, [this] { return finished_; });
    throw;
  }
}

void ReamingSession::stop() {
  const std::lock_guard one_at_a_time(stopping_);
  loop_.stop();
  std::unique_lock lock(mutex_);
  if (!files_) {
    if (status_.state == SessionState::created) status_.state = SessionState::stopped;
    return;
  }
  changed_.wait(lock, [this] { return finished_; });
}

SessionStatus ReamingSession::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

nlohmann::json ReamingSession::metrics() const {
  const std::lock_guard lock(mutex_);
  return metrics_;
}

std::shared_ptr<device::DevicePort> ReamingSession::port_of_device() const {
  if (!simulation_.link) return nullptr;
  const device::DeviceTraits& traits = simulation_.device->traits();
  const auto kind = request_.device == "browser" ? device::RemoteKind::steering : device::RemoteKind::handle;
  return std::make_shared<device::DevicePort>(
      simulation_.link, kind,
      device::DeviceWelcome{id_, request_.device, simulation_.model.settings.limits.force_max_n,
                            traits.stale});
}

/// Whatever goes wrong in the follower ends this session, not the server.
void ReamingSession::follow_to_the_end() {
  try {
    follow();
  } catch (const std::exception& e) {
    log::error("session " + id_ + ": its follower failed: " + e.what());
    loop_.request_stop();
    keep_black_box(recent_);
    {
      const std::lock_guard lock(mutex_);
      if (!finished_) status_.state = SessionState::fault;
      closing_ = finished_ = true;
      lock_.reset();
      place_.reset();
    }
    changed_.notify_all();
  }
}

void ReamingSession::follow() {
  int64_t last_told_ns = 0;
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (leaving_) return;
    }
    follow_once();
    copy_coverage_if_wanted();
    publisher_.poll(steady_ns());
    const int64_t now_ns = steady_ns();
    const SessionState state = status().state;
    if (state != SessionState::running && now_ns - last_told_ns > heartbeat_ns) {
      publish_state(state);
      last_told_ns = now_ns;
    }
    batcher_.publish_if_due(now_ns);
    std::this_thread::sleep_for(follower_period);
  }
}

std::string ReamingSession::start_failure() const {
  const std::lock_guard lock(mutex_);
  return start_failure_;
}

/// Takes what the loop has done, while there is a recording to put it in. From the last time on no remark is
/// accepted.
void ReamingSession::follow_once() {
  std::vector<record::ops::Annotation> remarks;
  bool relabelled = false;
  const bool ended = loop_.ended();  // read before draining: then nothing can be missed
  {
    const std::lock_guard lock(mutex_);
    if (!files_ || finished_) return;
    closing_ = ended || !start_failure_.empty();
    remarks.swap(remarks_);
    std::swap(relabelled, relabelled_);
  }
  try {
    if (relabelled) write_running(*files_);
    for (const record::ops::Annotation& remark : remarks) files_->add(remark);
    take(ended);
    if (ended)
      finish();
    else if (loop_.stood_still_ms() > 0)
      note_standstill();
    if (!start_failure().empty()) throw Error(ErrorKind::unavailable, start_failure());
  } catch (const std::exception& e) {
    end_without_force(e.what());
  }
}

void ReamingSession::take(bool ended) {
  const int64_t now_ns = steady_ns();
  const auto take_brick = [&](const voxel::BrickImage& image) {
    files_->add(image);  // before the replica has it: the recorder reads there what the brick was
    publisher_.take(image, now_ns);
  };
  bool any = false;
  const auto take_one = [&](const record::TickReport& report) {
    any = true;
    recent_.remember(report);
    take_report(files_->add(report));
    note_events(report);
  };
  if (ended)
    rings_.drain_rest(simulation_.bone_case.bone, simulation_.state.tick - 1, take_brick, take_one);
  else
    rings_.drain(take_brick, take_one);
  if (const std::string failure = files_->recorder().failure(); !failure.empty())
    throw Error(ErrorKind::io, "the recording failed and the session ended: " + failure);
  if (any) note_health();
}

void ReamingSession::take_report(const record::TickReport& r) {
  update_sample(r, sample_);
  sample_.state = r.paused ? SessionState::paused : SessionState::running;
  batcher_.add(sample_);
}

void ReamingSession::note_health() {
  const score::MetricsAccumulator& metrics = files_->metrics();
  const int64_t now_ns = steady_ns();
  live_score_.update(files_->metrics(),
                     {simulation_.bone_case.bone.grid, publisher_.replica().coverage().data()}, now_ns);
  const sim::LoopHealth health = loop_.health();
  sample_.depth_mm = static_cast<float>(metrics.reaming_depth_mm());
  sample_.removed_volume_mm3 = static_cast<float>(metrics.removed_volume_mm3());
  sample_.tick_mean_us = static_cast<float>(health.tick_us.mean_us);
  sample_.tick_p99_us = static_cast<float>(health.tick_us.p99_us);
  sample_.ticks_missed = static_cast<uint32_t>(health.missed);
  if (health.failed_over_tick >= 0 && !failover_told_) {
    failover_told_ = true;
    log::warn("session " + id_ + ": " + sim::failover_message(health.failed_over_tick));
    keep_black_box(recent_);
    files_->note_failover(health.failed_over_tick);
  }
  place_->measured(health.tick_us.p99_us, health.tick, health.missed);
  const std::lock_guard lock(mutex_);
  const bool held_or_let_go = held_ != status_.held;  // who asked for a pause sees what it left
  if (now_ns >= metrics_due_ns_ || held_or_let_go) {
    metrics_due_ns_ = now_ns + score::LiveScore::publish_period_ns;
    metrics_ =
        score::session_metrics_json(files_->metrics(), live_score_.results(), status_.force_scale, nullptr);
  }
  status_.tick = sample_.tick + 1;
  status_.duration_s = metrics.duration_s();
  status_.loop = health;
  note_device();
  if (status_.state == SessionState::running || status_.state == SessionState::paused)
    status_.state = sample_.state == SessionState::paused ? SessionState::paused : SessionState::running;
  status_.held = held_;
  if (held_or_let_go) changed_.notify_all();
}

void ReamingSession::publish_state(SessionState state) {
  sample_.state = state;
  tell_port();
  if (!is_live(state)) sample_.spindle_on = false;
  tell_fault(status().fault);
  batcher_.add(sample_);
  batcher_.flush();
}

}  // namespace ream::session
