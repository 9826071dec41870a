#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "force/vibration_kinds.hpp"
#include "force/vibration_settings.hpp"
#include "force/vibration_track.hpp"

namespace ream::force {

/// The prepared tracks of a session, one a kind. They do not change.
struct VibrationTracks {
  std::array<VibrationTrack, vibration_kinds> by_kind;

  /// Of all samples; equal on one machine whenever source and seed are equal.
  uint64_t hash() const;
};

/// Reads or synthesizes, and prepares. Nothing (null) when the source is off. Sessions that live at the same
/// time and have the same seed share what is synthesized. Errors: those of read_vibration_recording and
/// prepared_vibration; invalid_input when a file of a bone class is not given.
std::shared_ptr<const VibrationTracks> make_vibration_tracks(const VibrationSettings& settings,
                                                             uint64_t seed);

}  // namespace ream::force
