#include "api/stream_watch.hpp"

#include <algorithm>
#include <atomic>
#include <functional>

namespace ream::api {

/// What the watch knows of one open WebSocket.
struct StreamWatch::Stream {
  net::Caller caller;
  std::atomic<bool> ended{false};
  std::mutex mutex;
  std::function<void()> wake;

  void end() {
    if (ended.exchange(true)) return;
    const std::lock_guard lock(mutex);
    if (wake) wake();
  }
};

class StreamWatch::WatchedSession final : public net::WebSocketSession {
 public:
  WatchedSession(std::shared_ptr<Stream> stream, std::unique_ptr<net::WebSocketSession> inner)
      : stream_(std::move(stream)), inner_(std::move(inner)) {}

  void on_open(std::function<void()> wake) override {
    {
      const std::lock_guard lock(stream_->mutex);
      stream_->wake = wake;
    }
    inner_->on_open(std::move(wake));
  }
  bool sends_text() const override { return inner_->sends_text(); }
  std::optional<net::SharedBytes> next() override {
    if (stream_->ended) return std::nullopt;
    return inner_->next();
  }
  std::optional<net::CloseReason> close_reason() override {
    if (stream_->ended) return net::CloseReason{access_ended, "access has ended; log in again"};
    return inner_->close_reason();
  }
  void on_message(std::span<const std::byte> message) override {
    if (!stream_->ended) inner_->on_message(message);
  }
  void on_close() noexcept override {
    {
      const std::lock_guard lock(stream_->mutex);
      stream_->wake = nullptr;
    }
    inner_->on_close();
  }

 private:
  std::shared_ptr<Stream> stream_;
  std::unique_ptr<net::WebSocketSession> inner_;
};

StreamWatch::StreamWatch(access::AccessControl& access_control, std::chrono::milliseconds look_every)
    : access_control_(access_control),
      task_(
          "whether streams may go on could not be asked",
          [this, look_every] {
            look();
            return look_every;
          },
          look_every) {
  access_control_.credentials.on_change([this](const std::vector<std::string>& ids) { end(ids); });
  task_.start(look_every, false);
}

StreamWatch::~StreamWatch() { access_control_.credentials.on_change({}); }

std::unique_ptr<net::WebSocketSession> StreamWatch::watched(const net::Request& request,
                                                            std::unique_ptr<net::WebSocketSession> inner) {
  auto stream = std::make_shared<Stream>();
  stream->caller = request.caller;
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(streams_, [](const auto& gone) { return gone.expired(); });
    streams_.push_back(stream);
  }
  // Revoked, or the first user came, between its check and here: nobody would tell.
  if (!may_go_on(*stream)) stream->end();
  return std::make_unique<WatchedSession>(std::move(stream), std::move(inner));
}

std::vector<std::shared_ptr<StreamWatch::Stream>> StreamWatch::open_streams() {
  std::vector<std::shared_ptr<Stream>> open;
  const std::lock_guard lock(mutex_);
  for (const auto& known : streams_)
    if (auto stream = known.lock()) open.push_back(std::move(stream));
  return open;
}

void StreamWatch::end(const std::vector<std::string>& credentials) {
  for (const auto& stream : open_streams())
    if (std::find(credentials.begin(), credentials.end(), stream->caller.credential) != credentials.end())
      stream->end();
}

bool StreamWatch::may_go_on(const Stream& stream) {
  if (stream.caller.credential.empty()) return !access_control_.users.any();
  const auto identity = access_control_.credentials.identify_again(stream.caller.credential);
  return identity && access::to_text(identity->role) == stream.caller.role;
}

void StreamWatch::look() {
  for (const auto& stream : open_streams())
    if (!stream->ended && !may_go_on(*stream)) stream->end();
}

}  // namespace ream::api
