#include "session/live/viewer_stream.hpp"

namespace ream::session {
namespace {

class ViewerStream final : public net::WebSocketSession {
 public:
  ViewerStream(std::shared_ptr<stream::Fanout> fanout, int stride)
      : fanout_(std::move(fanout)), stride_(stride) {}

  void on_open(std::function<void()> wake) override {
    mailbox_ = fanout_->subscribe(std::move(wake), stride_);
  }

  std::optional<net::SharedBytes> next() override {
    net::SharedBytes message = mailbox_->next();
    if (!message) return std::nullopt;
    return message;
  }

  void on_message(std::span<const std::byte>) override {}

  void on_close() noexcept override { mailbox_.reset(); }

 private:
  std::shared_ptr<stream::Fanout> fanout_;
  int stride_;
  std::shared_ptr<stream::Mailbox> mailbox_;
};

}  // namespace

std::unique_ptr<net::WebSocketSession> viewer_stream(std::shared_ptr<stream::Fanout> fanout, int stride) {
  return std::make_unique<ViewerStream>(std::move(fanout), stride);
}

}  // namespace ream::session
