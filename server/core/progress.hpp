#pragma once
#include <functional>
#include <string_view>

namespace ream {

/// Called by long work with how far it has come: share from 0 to 1, and what it does now, briefly, for people
/// ("reading slices"). Called from the thread that works. It may throw Error cancelled, which the work lets
/// through after leaving nothing half-written.
using Progress = std::function<void(double share, std::string_view step)>;

/// For work that nobody waits for.
inline void no_progress(double, std::string_view) {}

/// The part of a whole from `from` to `to`: what work inside it reports as 0 to 1.
inline Progress part_of(const Progress& whole, double from, double to) {
  return [whole, from, to](double share, std::string_view step) { whole(from + (to - from) * share, step); };
}

}  // namespace ream
