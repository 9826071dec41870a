#include "sim/failover.hpp"

namespace ream::sim {

bool fail_over(State& state) noexcept {
  if (state.failed_over_tick >= 0 || state.reserve.narrow_phase == nullptr) return false;
  std::swap(state.backend, state.reserve);
  state.failed_over_tick = state.tick - 1;  // the step has counted its tick already
  return true;
}

}  // namespace ream::sim
