// What Haply's service says: its inventory, frames and events.
#include "core/error.hpp"
#include "device/vendors/haply_messages.hpp"
#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  device::HaplyReader reader("", "");
  try {
    reader.take_inventory(input.piece());
    while (!input.empty()) {
      const std::string_view message = input.piece();
      std::string why;
      const bool taken = reader.take_state(message, why);
      fuzz::require(taken != !why.empty() || taken, "a frame was refused without a word");
      const device::HaplyDevice& device = reader.device();
      fuzz::require(!taken || device.position_m.allFinite(), "a place that is no number was taken");
      device::read_haply_event(message, device.device_id);
    }
  } catch (const Error&) {
  }
  return 0;
}
