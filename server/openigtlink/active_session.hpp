#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "geometry/triangle_mesh.hpp"
#include "stream/fanout.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::openigtlink {

/// A session as those who watch over OpenIGTLink are to see it.
struct SessionView {
  std::string id;
  std::string description;  ///< one line: case, side, reamer
  voxel::VoxelGrid grid;
  TriangleMesh tool;  ///< tool frame
  std::weak_ptr<stream::Fanout> fanout;
};

/// The one session that is shown: the last that was put here. Sessions come and go on threads of their own;
/// all functions are thread-safe and none waits for a client.
class ActiveSession {
 public:
  void set(std::shared_ptr<const SessionView> session) {
    const std::lock_guard lock(mutex_);
    session_ = std::move(session);
  }
  /// Null: there has not been any.
  std::shared_ptr<const SessionView> get() const {
    const std::lock_guard lock(mutex_);
    return session_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const SessionView> session_;
};

}  // namespace ream::openigtlink
