#include "session/replay/replay_session.hpp"

#include <algorithm>
#include <chrono>

#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/log.hpp"
#include "core/signal_handlers.hpp"
#include "score/bone_results.hpp"
#include "score/metrics.hpp"
#include "session/folder/session_folder.hpp"
#include "session/live/viewer_stream.hpp"
#include "session/replay/recorded_stream.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"

namespace ream::session {
namespace {

/// A request for metrics waits this long for the recording to be read.
constexpr auto metrics_timeout = std::chrono::seconds(1);
constexpr auto replay_period = std::chrono::milliseconds(10);
/// A replay that rests tells its viewers so this often, so that a silent link is a broken one.
constexpr int64_t replay_heartbeat_ns = 500'000'000;

ReplaySession::Bone bone_before(const record::Recording& recording, const std::filesystem::path& data) {
  if (recording.tick_count() == 0)
    throw Error(ErrorKind::invalid_input, recording.log().path().string() + " holds no tick to show");
  case_::Case native = recorded_case(recording, {}, data);
  auto glenoid = glenoid_if_known(recording, native, {}, data);
  return {as_before_tick_0(recording, std::move(native)), std::move(glenoid)};
}

/// What the session said of itself when it ended; null where it left none that can be read.
nlohmann::json kept_metrics(const std::filesystem::path& session) {
  const std::filesystem::path file = metrics_json(session);
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) return nullptr;
  try {
    return read_json_file(file);
  } catch (const Error& e) {
    log::warn(e.what());
    return nullptr;
  }
}

/// Whether both were said of the same ticks and the same bone.
bool same_moment(const nlohmann::json& kept, const nlohmann::json& now) {
  const auto same = [&](const char* key) {
    return now.at(key).is_string() && kept.value(key, nlohmann::json()) == now.at(key);
  };
  return kept.is_object() && same("session_hash") && same("grid_hash");
}

score::MetricsAccumulator no_metrics(const case_::Case& c) {
  return {c.bone.grid.voxel_volume_mm3(), sim::world_from_plan(*c.plan).inverse()};
}

}  // namespace

ReplaySession::ReplaySession(const SessionContext& context, const ReplayRequest& request)
    : context_(context),
      request_(request),
      recording_(sessions_folder(context.data) / request.replay_of / "recording.ream"),
      kept_metrics_(kept_metrics(sessions_folder(context.data) / request.replay_of)),
      bone_(bone_before(recording_, context.data)),
      timeline_(recording_, bone_.start.bone.grid.world_from_grid, no_metrics(bone_.start)),
      fanout_(std::make_shared<stream::Fanout>()),
      picture_(recording_, bone_.start, bone_.native, timeline_, hello(), *fanout_),
      playhead_(recording_.tick_count()) {
  bone_hash_ = picture_.bone_hash();
  depth_mm_ = picture_.depth_mm();
  last_watched_ns_ = steady_ns();
  follower_ = start_thread([this] { follow(); });
}

ReplaySession::~ReplaySession() { stop(); }

stream::HelloInfo ReplaySession::hello() const {
  stream::HelloInfo info = recorded_hello(recording_, bone_.start);
  info.session_id = request_.id;
  info.server_epoch = context_.server_epoch;
  info.replay_of = request_.blind ? request_.id : request_.replay_of;
  return info;
}

PlaybackStatus ReplaySession::status() const {
  const std::lock_guard lock(mutex_);
  PlaybackStatus status;
  status.position_s = playhead_.position_ticks() * tick_s;
  status.duration_s = playhead_.duration_ticks() * tick_s;
  status.speed = playhead_.speed();
  status.playing = playhead_.playing();
  status.fault = fault_;
  if (const std::vector<RecordingDamage> found = damage(); !found.empty())
    status.warning = found.front().words;
  status.force_scale = recording_.header().force_scale;
  if (fanout_->viewers() == 0)
    status.unwatched_s = static_cast<double>(steady_ns() - last_watched_ns_) * 1e-9;
  return status;
}

/// In order of time: among the ticks, and what made the end of the file useless.
std::vector<RecordingDamage> ReplaySession::damage() const {
  std::vector<RecordingDamage> found;
  if (RecordingDamage among_ticks = timeline_.damage(); !among_ticks.words.empty())
    found.push_back(std::move(among_ticks));
  if (const std::string& words = recording_.log().damage(); !words.empty())
    found.push_back({recording_.tick_count(), words});
  return found;
}

std::vector<ReplayMark> ReplaySession::marks() const {
  std::vector<ReplayMark> marks = recorded_marks(recording_);
  for (const RecordingDamage& damage : damage())
    marks.push_back({damage.after_ticks * tick_s, "damaged", damage.words});
  std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.at_s < b.at_s; });
  return marks;
}

nlohmann::json ReplaySession::metrics() const {
  uint32_t ticks = 0;
  std::optional<uint64_t> grid_hash;
  std::optional<double> depth_mm;
  {
    const std::lock_guard lock(mutex_);
    ticks = playhead_.position_ticks();
    if (bone_ticks_ == ticks) grid_hash = bone_hash_;
    depth_mm = depth_mm_;
  }
  score::MetricResults of_bone =
      score::missing_bone_results("the bone is measured at the session's end only");
  if (depth_mm) of_bone.set("reaming_depth_mm", *depth_mm);
  nlohmann::json now =
      score::session_metrics_json(timeline_.wait_for(ticks, metrics_timeout), of_bone,
                                  recording_.header().force_scale, grid_hash ? &*grid_hash : nullptr);
  return same_moment(kept_metrics_, now) ? kept_metrics_ : now;
}

void ReplaySession::change(const PlaybackChange& change) {
  {
    const std::lock_guard lock(mutex_);
    playhead_.change(change);
    fault_.clear();
  }
  changed_.notify_all();
}

void ReplaySession::stop() {
  const std::lock_guard one_at_a_time(stopping_);
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return;
    ended_ = true;
  }
  changed_.notify_all();
  follower_.join();
  picture_.publish_state(SessionState::stopped);
}

std::unique_ptr<net::WebSocketSession> ReplaySession::subscribe(int stride) {
  return viewer_stream(fanout_, stride);
}

void ReplaySession::follow() {
  int64_t before_ns = steady_ns();
  for (;;) {
    ReplayMoment moment;
    const int64_t now_ns = steady_ns();
    try {
      {
        const std::lock_guard lock(mutex_);
        if (ended_) return;
        playhead_.advance(now_ns - before_ns);
        moment = {playhead_.position_ticks(), playhead_.jumps(), static_cast<float>(playhead_.speed()),
                  playhead_.playing(), fault_};
        if (fanout_->viewers() > 0) last_watched_ns_ = now_ns;
      }
      before_ns = now_ns;
      show_moment(moment, now_ns);
    } catch (const std::exception& e) {
      rest_with_fault(e.what(), moment.jump);
    }
    std::unique_lock lock(mutex_);
    bone_ticks_ = picture_.bone_ticks();
    bone_hash_ = picture_.bone_hash();
    depth_mm_ = picture_.depth_mm();
    changed_.wait_for(lock, replay_period, [&] { return ended_ || playhead_.jumps() != moment.jump; });
  }
}

void ReplaySession::show_moment(const ReplayMoment& moment, int64_t now_ns) {
  picture_.show(moment);
  picture_.poll(steady_ns());
  if (moment.playing || now_ns - last_published_ns_ <= replay_heartbeat_ns) return;
  picture_.publish_state(SessionState::replaying);
  last_published_ns_ = now_ns;
}

/// Rests where the picture stands, which could be read; another jump since then stays wanted.
void ReplaySession::rest_with_fault(const std::string& words, uint32_t jump) {
  if (words != logged_fault_) log::error("replay of session " + request_.replay_of + ": " + words);
  logged_fault_ = words;
  const std::lock_guard lock(mutex_);
  if (playhead_.jumps() != jump) return;
  playhead_.rest_at(picture_.ticks());
  fault_ = words;
}

}  // namespace ream::session
