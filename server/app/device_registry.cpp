#include "app/device_registry.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "device/profiles.hpp"

namespace ream::app {
namespace {

DeviceKind scripted() {
  return {"script",
          [] {
            const device::DeviceTraits ideal = device::device_profile("ideal");
            return DeviceOffer{"script",
                               "A simulated hand, robot or list of poses that plays a script",
                               true,
                               "",
                               ideal.force_max_n,
                               ideal.degrees_of_freedom};
          },
          [](const DeviceWish& wish) {
            return MadeDevice{
                device::make_scripted_device(*wish.script, wish.world_from_plan, wish.random_seed), nullptr};
          }};
}

}  // namespace

const std::vector<DeviceKind>& device_kinds() {
  static const std::vector<DeviceKind> kinds{scripted()};
  return kinds;
}

MadeDevice make_device(const DeviceWish& wish) {
  const std::vector<DeviceKind>& kinds = device_kinds();
  const auto kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const DeviceKind& k) { return k.name == wish.name; });
  if (kind != kinds.end()) return kind->make(wish);
  std::string names;
  for (const DeviceKind& known : kinds) names += (names.empty() ? "" : ", ") + known.name;
  throw Error(ErrorKind::invalid_input,
              "no device '" + wish.name + "'; there are " + names + " (`ream devices` tells more)");
}

}  // namespace ream::app
