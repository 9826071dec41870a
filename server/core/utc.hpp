#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace ream {

using UtcMoment = std::chrono::system_clock::time_point;
/// What time it is; tests set it by hand.
using WallClock = std::function<UtcMoment()>;

/// The machine's.
WallClock machine_clock();

/// A moment as "2025-03-01T12:00:00Z"; later ones are greater texts.
std::string utc_text(UtcMoment moment);
/// The moment of such a text. Error invalid_input for any other.
UtcMoment utc_moment(const std::string& text);

}  // namespace ream
