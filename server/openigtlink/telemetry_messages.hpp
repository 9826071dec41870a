#pragma once
#include <array>
#include <cstdint>

#include "openigtlink/active_session.hpp"
#include "openigtlink/messages.hpp"
#include "stream/telemetry.hpp"

namespace ream::openigtlink {

/// What is sent, one message of each at a time. The names are those of the nodes in 3D Slicer.
enum class Topic : size_t { session, status, reamer_pose, bone_pose, force, torque, reamer, bone };
inline constexpr size_t topic_count = 8;

/// The newest message of every topic; clients remember which of them they have.
class MessageCache {
 public:
  void put(Topic topic, Message message) {
    CachedMessage& cached = messages_[static_cast<size_t>(topic)];
    cached = {std::move(message), ++version_};
  }
  /// Nothing of the last session is sent any more.
  void clear() { messages_ = {}; }

  struct CachedMessage {
    Message message;       ///< null: there is none
    uint64_t version = 0;  ///< grows
  };
  const CachedMessage& message(size_t topic) const { return messages_[topic]; }

 private:
  std::array<CachedMessage, topic_count> messages_;
  uint64_t version_ = 0;
};

/// Puts what a session is, once for each: STRING "Session" and POLYDATA "Reamer" (tool frame: it belongs
/// under "ReamerToRas").
void put_session(const SessionView& session, int64_t unix_ns, MessageCache& cache);

/// What was put last, so that it is put again only when it has changed.
struct LastSent {
  std::string status;
  bool bone_moved = false;
};

/// Puts what one tick was: TRANSFORM "ReamerToRas" (the tool's frame: origin at the apex, z into the bone)
/// and, where the bone has moved from where its surface has it, "BoneToRas"; SENSOR "Force", N: simulated
/// thrust along the tool's z, magnitude of the force on the hand; SENSOR "Torque", N m: magnitude of the
/// moment about the tool's origin; STATUS "Simulator" when it has changed.
void put_tick(const stream::TelemetrySample& tick, int64_t unix_ns, LastSent& sent, MessageCache& cache);

/// STATUS "Simulator" while no session has been started.
void put_no_session(int64_t unix_ns, MessageCache& cache);

}  // namespace ream::openigtlink
