#pragma once
#include <array>
#include <cstdint>

#include "openigtlink/messages.hpp"

namespace ream::openigtlink {

/// What is told, one message of each at a time. The names are those of the nodes in 3D Slicer.
enum class Topic : size_t { session, status, reamer_pose, bone_pose, force, torque, reamer, bone };
inline constexpr size_t topic_count = 8;

/// The newest message of every topic; clients remember which of them they have.
class Board {
 public:
  void put(Topic topic, Message message) {
    Sheet& sheet = sheets_[static_cast<size_t>(topic)];
    sheet = {std::move(message), ++edition_};
  }
  /// Nothing of the last session is told any more.
  void clear() { sheets_ = {}; }

  struct Sheet {
    Message message;       ///< null: there is none
    uint64_t edition = 0;  ///< grows
  };
  const Sheet& sheet(size_t topic) const { return sheets_[topic]; }

 private:
  std::array<Sheet, topic_count> sheets_;
  uint64_t edition_ = 0;
};

}  // namespace ream::openigtlink
