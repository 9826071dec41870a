#pragma once
// Inside of net only.
#include <chrono>
#include <memory>

#include "net/channel.hpp"
#include "net/watchdog.hpp"

namespace ream::net {

/// Closes `channel` so that the peer gets our last words: tells it that nothing more comes and reads on until
/// it closes too, for `linger` at most. Closing a socket with unread input would reset it, and what the peer
/// has not read by then may be lost. `owner` keeps both alive; nothing else may be reading.
void close_lingering(Channel& channel, Watchdog& watchdog, std::chrono::milliseconds linger,
                     std::shared_ptr<void> owner);

}  // namespace ream::net
