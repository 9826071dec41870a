#include <nlohmann/json.hpp>

#include "api/annotation_op.hpp"
#include "api/viewer_stream.hpp"
#include "app/reaming_session.hpp"
#include "core/error.hpp"

namespace ream::app {
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

void ReamingSession::go_on() { hold(false); }

bool ReamingSession::relabel(const api::SessionRequest& request) {
  std::unique_lock lock(mutex_);
  if (closing_) changed_.wait(lock, [this] { return finished_; });
  if (!api::is_live(status_.state)) return false;
  labels_ = request;
  relabelled_ = true;
  return true;
}

api::Annotation ReamingSession::annotate(const api::NewAnnotation& note) {
  std::unique_lock lock(mutex_);
  if (closing_) changed_.wait(lock, [this] { return finished_; });
  if (!files_ || finished_)
    throw Error(ErrorKind::conflict,
                "session '" + id_ + "' is " + api::to_text(status_.state) + "; a remark needs a recording");
  remarks_.push_back(api::annotation_op(note, status_.tick));
  annotations_.push_back(remarks_.back());
  return api::annotation_of(remarks_.back());
}

std::vector<api::Annotation> ReamingSession::annotations() const {
  const std::lock_guard lock(mutex_);
  std::vector<api::Annotation> annotations;
  for (const record::ops::Annotation& op : annotations_) annotations.push_back(api::annotation_of(op));
  return annotations;
}

std::unique_ptr<net::WebSocketSession> ReamingSession::subscribe(int stride) {
  return api::viewer_stream(fanout_, stride);
}

std::unique_ptr<net::WebSocketSession> ReamingSession::connect_device() {
  if (port_) return port_->connect();
  throw Error(ErrorKind::conflict,
              "session '" + id_ + "' has the device '" + request_.device +
                  "', which does not connect itself; a session with the device 'browser' "
                  "or 'network' waits for a client");
}

}  // namespace ream::app
