#include "device/link_state.hpp"

namespace ream::device {

const char* to_text(LinkState state) noexcept {
  switch (state) {
    case LinkState::fresh:
      return "fresh";
    case LinkState::held:
      return "held";
    case LinkState::fading:
      return "fading";
    case LinkState::lost:
      return "lost";
  }
  return "lost";
}

}  // namespace ream::device
