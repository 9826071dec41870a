#pragma once
#include "collide/contact/narrow_phase.hpp"
#include "device/haptic_device.hpp"
#include "force/coupling.hpp"
#include "sim/state.hpp"

namespace ream::sim {

/// Handle minus tool in the tool frame: mm, then rotation vector in rad.
force::Vec6 handle_minus_tool(const Pose& world_from_tool, const Pose& world_from_handle) noexcept;

/// The tool moved by `fraction` of a motion in its own frame.
Pose moved(const Pose& world_from_tool, const force::Vec6& motion, double fraction = 1.0) noexcept;

/// The most that the tool may travel in this tick, mm: as far as the spring of the coupling, `stretch_mm`
/// long, brings its mass from the speed of the last tick. Slowing down takes no time: what is lost then warms
/// bone and hand. Infinite without a drive, which has the mass, and with a virtual mass.
double max_travel_mm(const Model& model, const State& state, double stretch_mm) noexcept;

/// Adds what the spring does to a tool that slips towards the hand after bone let it go.
void add_slip(const Model& model, const State& state, const Pose& world_from_handle, ToolLoad& load) noexcept;

/// One tick of a tool that touches bone: spring, feed law, friction and the motion that follows. Moves
/// state.world_from_tool and fills the report's part about contact.
ToolLoad press(const Model& model, State& state, const collide::ContactSums& sums,
               const device::DeviceInput& input, TickReport& report) noexcept;

}  // namespace ream::sim
