#pragma once
#include <memory>
#include <mutex>
#include <string>

#include "geometry/triangle_mesh.hpp"
#include "stream/fanout.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::openigtlink {

/// A session as those who watch over OpenIGTLink are to see it.
struct ShownSession {
  std::string id;
  std::string words;  ///< one line: case, side, reamer
  voxel::VoxelGrid grid;
  TriangleMesh tool;  ///< tool frame
  std::weak_ptr<stream::Fanout> fanout;
};

/// The one session that is shown: the last that was put here. Sessions come and go on threads of their own;
/// all functions are thread-safe and none waits for a client.
class Showcase {
 public:
  void show(std::shared_ptr<const ShownSession> session);
  /// Null: there has not been any.
  std::shared_ptr<const ShownSession> shown() const;

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const ShownSession> shown_;
};

}  // namespace ream::openigtlink
