#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "core/clock.hpp"
#include "openigtlink/active_session.hpp"
#include "sim/cpu_allocator.hpp"
#include "sim/realtime.hpp"

namespace ream::session {

/// What all sessions and replays of one server share.
struct SessionContext {
  std::filesystem::path data;
  uint64_t server_epoch = 0;  ///< differs after each start of the server
  std::string backend = "auto";
  sim::Realtime realtime = sim::Realtime::attempt;
  std::shared_ptr<sim::CpuAllocator> cpus = std::make_shared<sim::CpuAllocator>();
  double tool_spacing_mm = 0.3;  ///< of the points that feel bone
  std::shared_ptr<openigtlink::ActiveSession> openigtlink_session = nullptr;  ///< null: nobody watches by it
  std::filesystem::path page = {};        ///< page_folder(), for review files
  int64_t (*guard_now_ns)() = steady_ns;  ///< the clock by which each loop is watched; see sim::LoopGuard
};

}  // namespace ream::session
