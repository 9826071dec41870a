#pragma once
#include <utility>

#include "sim/state.hpp"

namespace ream::sim {

/// Puts the reserve in the failed backend's place; the failed one is kept, for giving it back takes time that
/// a tick has not. False when there is no reserve (any more). What the failed device left behind: bone on the
/// host is as before its last call (Removal::cut, Decay::apply), so the reserve does the same work again and
/// the tick's result, coverage and hash are those of a session without a failure.
bool fail_over(State& state) noexcept;

/// Calls `work(backend)`, which answers false when the device failed, once more with the reserve if need be.
template <class Work>
bool work_or_fail_over(State& state, Work work) noexcept {
  return work(state.backend) || (fail_over(state) && work(state.backend));
}

}  // namespace ream::sim
