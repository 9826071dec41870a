#pragma once
#include <optional>

#include "sim/state.hpp"

namespace ream::sim {

/// The guide that the plan asks for; a nipple is what of the tool guides above its apex. Error conflict when
/// the tool has none, or it does not fit the pilot hole, or there is no hole.
std::optional<force::Guide> make_guide(const Model& model);

/// Where the guide lets the tool follow the handle to; the handle itself without a guide.
Pose guided(const Model& model, State& state, const Pose& world_from_handle) noexcept;

/// Adds what the spring between handle and tool puts on the guide, and tells its force. Nothing while the
/// tool is not in it.
void add_guide(const Model& model, const State& state, const Pose& world_from_handle,
               const Pose& world_from_guided, ToolLoad& load, TickReport& report) noexcept;

/// Puts a moved tool back between the guide's walls, and notes whether it has gone in or come out.
void keep_in_guide(const Model& model, State& state) noexcept;

}  // namespace ream::sim
