#pragma once
#include <memory>

#include "net/websocket.hpp"
#include "stream/fanout.hpp"

namespace ream::session {

/// A viewer's WebSocket onto a session's fanout: it subscribes when the connection opens, sends what its
/// mailbox holds (the surface at `stride`) as fast as the viewer takes it, and lets go of the mailbox when
/// the connection ends. What a viewer says is ignored.
std::unique_ptr<net::WebSocketSession> viewer_stream(std::shared_ptr<stream::Fanout> fanout, int stride);

}  // namespace ream::session
