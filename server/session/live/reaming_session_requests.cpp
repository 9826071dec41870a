#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "geometry/mesh_io.hpp"
#include "session/annotation_op.hpp"
#include "session/live/reaming_session.hpp"
#include "session/live/viewer_stream.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/reamed_pictures.hpp"

namespace ream::session {
namespace {

/// A loop ticks again within a few ms, or stands still and its session ends by itself.
constexpr std::chrono::seconds longest_wait{2};

}  // namespace

void ReamingSession::hold(bool held) {
  loop_.pause(held);
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, longest_wait, [&] { return status_.held == held || finished_; });
}

void ReamingSession::pause() { hold(true); }

void ReamingSession::unpause() { hold(false); }

bool ReamingSession::relabel(const SessionRequest& request) {
  std::unique_lock lock(mutex_);
  if (closing_) changed_.wait(lock, [this] { return finished_; });
  if (!is_live(status_.state)) return false;
  labels_ = request;
  relabelled_ = true;
  return true;
}

/// The replica is the follower's, so the follower copies it.
void ReamingSession::copy_coverage_if_wanted() {
  const std::lock_guard lock(mutex_);
  if (wanted_coverage_ == nullptr) return;
  *wanted_coverage_ = publisher_.replica().coverage();
  wanted_coverage_ = nullptr;
  changed_.notify_all();
}

std::vector<uint8_t> ReamingSession::coverage_now() {
  std::vector<uint8_t> coverage;
  const std::lock_guard one_at_a_time(copying_);
  std::unique_lock lock(mutex_);
  wanted_coverage_ = &coverage;
  if (changed_.wait_for(lock, longest_wait, [this] { return wanted_coverage_ == nullptr; })) return coverage;
  wanted_coverage_ = nullptr;
  throw Error(ErrorKind::unavailable, "session '" + id_ + "' does not answer; try again");
}

/// The haptic thread writes the session's own bone, so the case is loaded once more.
case_::Case ReamingSession::intact_case() const {
  case_::Case intact = find_case(request_.case_id, context_.data);
  intact.plan = simulation_.model.plan;
  case_::cut_pilot_hole(intact.bone, *intact.plan);
  return intact;
}

void ReamingSession::write_surface(const std::filesystem::path& ply, int stride) {
  case_::Case reamed = intact_case();
  reamed.bone.coverage = coverage_now();
  write_ply(ply, reamed_surface(reamed, stride), case_::frame_in_words(reamed.side));
}

void ReamingSession::write_picture(const std::filesystem::path& png) {
  case_::Case reamed = intact_case();
  std::vector<uint8_t> before = coverage_now();
  before.swap(reamed.bone.coverage);
  session::write_picture(reamed, before, png);
}

Annotation ReamingSession::annotate(const NewAnnotation& note) {
  std::unique_lock lock(mutex_);
  if (closing_) changed_.wait(lock, [this] { return finished_; });
  if (!files_ || finished_)
    throw Error(ErrorKind::conflict,
                "session '" + id_ + "' is " + to_text(status_.state) + "; a remark needs a recording");
  remarks_.push_back(annotation_op(note, status_.tick));
  annotations_.push_back(remarks_.back());
  return annotation_of(remarks_.back());
}

std::vector<Annotation> ReamingSession::annotations() const {
  const std::lock_guard lock(mutex_);
  std::vector<Annotation> annotations;
  for (const record::ops::Annotation& op : annotations_) annotations.push_back(annotation_of(op));
  return annotations;
}

std::unique_ptr<net::WebSocketSession> ReamingSession::subscribe(int stride) {
  return viewer_stream(fanout_, stride);
}

std::unique_ptr<net::WebSocketSession> ReamingSession::connect_device() {
  if (port_) return port_->connect();
  throw Error(ErrorKind::conflict,
              "session '" + id_ + "' has the device '" + request_.device +
                  "', which does not connect itself; a session with the device 'browser' "
                  "or 'network' waits for a client");
}

}  // namespace ream::session
