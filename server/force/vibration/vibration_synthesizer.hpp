#pragma once
#include <cstdint>
#include <vector>

#include "force/vibration/vibration_tracks.hpp"

namespace ream::force {

/// Raw vibration of one kind at 22,050 Hz, to be prepared as a recording is. Noise and, for bone, blows of
/// bounded random size come through one colouring filter without a resonance: the spectrum rises up to the
/// end of what a hand can feel and has no line, and peak-to-peak is 13 to 16 times g_rms where a Gaussian has
/// 7 to
/// 8. Same seed, same samples on one machine; other seeds are independent of each other, and so are kinds.
std::vector<double> synthesized_vibration(VibrationKind kind, uint64_t seed);

}  // namespace ream::force
