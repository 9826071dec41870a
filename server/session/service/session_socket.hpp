#pragma once
#include <memory>

#include "net/websocket.hpp"

namespace ream::session {

/// A viewer's or device's connection, which keeps the session that it belongs to.
class SessionSocket : public net::WebSocketSession {
 public:
  SessionSocket(std::shared_ptr<void> kept, std::unique_ptr<net::WebSocketSession> inner)
      : kept_(std::move(kept)), inner_(std::move(inner)) {}
  void on_open(std::function<void()> wake) override { inner_->on_open(std::move(wake)); }
  bool sends_text() const override { return inner_->sends_text(); }
  std::optional<net::SharedBytes> next() override { return inner_->next(); }
  std::optional<net::CloseReason> close_reason() override { return inner_->close_reason(); }
  void on_message(std::span<const std::byte> message) override { inner_->on_message(message); }
  void on_close() noexcept override { inner_->on_close(); }

 private:
  std::shared_ptr<void> kept_;
  std::unique_ptr<net::WebSocketSession> inner_;
};

}  // namespace ream::session
