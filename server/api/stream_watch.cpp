#include "api/stream_watch.hpp"

#include <algorithm>
#include <atomic>
#include <functional>

#include "core/error.hpp"
#include "core/log.hpp"

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

StreamWatch::StreamWatch(access::Credentials& credentials, std::chrono::milliseconds look_every)
    : credentials_(credentials), look_every_(look_every) {
  credentials_.on_change([this](const std::vector<std::string>& ids) { end(ids); });
  thread_ = std::thread([this] { look(); });
}

StreamWatch::~StreamWatch() {
  credentials_.on_change({});
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::unique_ptr<net::WebSocketSession> StreamWatch::watched(const net::Request& request,
                                                            std::unique_ptr<net::WebSocketSession> inner) {
  if (request.caller.credential.empty()) return inner;
  auto stream = std::make_shared<Stream>();
  stream->caller = request.caller;
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(streams_, [](const auto& gone) { return gone.expired(); });
    streams_.push_back(stream);
  }
  // Revoked between its check and here: nobody would tell.
  if (!credentials_.identify_again(request.caller.credential)) stream->end();
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

void StreamWatch::look() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, look_every_, [this] { return stopped_; })) {
    lock.unlock();
    try {
      look_at_all();
    } catch (const Error& failure) {
      log::warn(std::string("whether streams may go on could not be asked: ") + failure.what());
    }
    lock.lock();
  }
}

void StreamWatch::look_at_all() {
  for (const auto& stream : open_streams()) {
    if (stream->ended) continue;
    const auto identity = credentials_.identify_again(stream->caller.credential);
    if (!identity || access::to_text(identity->role) != stream->caller.role) stream->end();
  }
}

}  // namespace ream::api
