#pragma once
#include <memory>
#include <vector>

#include "record/op_log.hpp"
#include "record/replay_device.hpp"

namespace ream::python {

/// What the hand did in each tick since the first, so that the session can be computed again: 52 bytes a
/// tick. Copies share what they have in common.
class CauseLog {
 public:
  void add(const record::ops::Tick& tick) {
    if (size_ % chunk_ticks == 0) {
      chunks_.push_back(std::make_shared<Chunk>());
      chunks_.back()->reserve(chunk_ticks);
    } else if (chunks_.back().use_count() > 1) {
      chunks_.back() = std::make_shared<Chunk>(*chunks_.back());
    }
    chunks_.back()->push_back({tick.world_from_handle, tick.flags});
    ++size_;
  }

  size_t size() const { return size_; }
  size_t bytes() const { return size_ * sizeof(record::ReplayDevice::Cause); }

  std::vector<record::ReplayDevice::Cause> all() const {
    std::vector<record::ReplayDevice::Cause> causes;
    causes.reserve(size_);
    for (const auto& chunk : chunks_) causes.insert(causes.end(), chunk->begin(), chunk->end());
    return causes;
  }

 private:
  using Chunk = std::vector<record::ReplayDevice::Cause>;
  static constexpr size_t chunk_ticks = 1000;
  std::vector<std::shared_ptr<Chunk>> chunks_;
  size_t size_ = 0;
};

}  // namespace ream::python
