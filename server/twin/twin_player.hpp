#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "twin/bone_twin.hpp"

namespace ream::twin {

/// Computes a session's bone from its parts (cause_parts.hpp), which may come from anywhere, and says whether
/// it agrees with what the session said of itself. One thread.
class TwinPlayer {
 public:
  enum class Outcome : uint8_t {
    agrees = 0,
    damaged = 1,  ///< no part, or not the next one
    differs = 2,  ///< computed well, and another bone or hash comes of it
  };

  /// Takes the next part, its code first. After anything but `agrees` only that comes again.
  Outcome take(std::span<const std::byte> part);

  /// Ticks computed whose hashes agreed.
  uint32_t agreed_ticks() const { return agreed_ticks_; }
  bool ended() const { return ended_; }
  /// Of the whole recording, once it has ended: more than those that agreed where its last ticks have no
  /// bone, as of a program that was killed.
  uint32_t recorded_ticks() const { return recorded_ticks_; }
  /// Keeps what has been computed, for go_to(); its number, as BoneTwin::keep_snapshot. Empty before the
  /// start, after the end, and where parts do not agree.
  std::optional<size_t> keep_snapshot();
  /// The next part is the one that came after that snapshot, whatever became of those since. False, with
  /// nothing changed, for no such snapshot.
  bool go_to(size_t snapshot);
  /// Empty before the start.
  BoneTwin* twin() { return twin_ ? &*twin_ : nullptr; }

 private:
  Outcome take_start(std::span<const std::byte> bytes);
  Outcome take_density(std::span<const std::byte> bytes);
  Outcome take_segment(std::span<const std::byte> bytes);
  Outcome take_ticks(std::span<const std::byte> bytes);
  Outcome take_end(std::span<const std::byte> bytes);

  std::optional<BoneTwin> twin_;
  uint32_t agreed_ticks_ = 0, recorded_ticks_ = 0;
  bool has_segment_ = false, ended_ = false;
  Outcome outcome_ = Outcome::agrees;
  struct Snapshot {
    uint32_t agreed_ticks = 0;
    bool has_segment = false;
  };
  std::vector<Snapshot> snapshots_;
};

}  // namespace ream::twin
