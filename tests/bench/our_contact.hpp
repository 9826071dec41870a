#pragma once
#include <memory>

#include "bench/measure.hpp"
#include "collide/contact/narrow_phase.hpp"
#include "gpu/device.hpp"

namespace ream::bench {

/// A bone with everything that the product's contact derives from it before the first tick.
struct OurBone {
  explicit OurBone(voxel::BoneModel model);
  OurBone(const OurBone&) = delete;
  OurBone& operator=(const OurBone&) = delete;

  voxel::BoneModel bone;
  voxel::BrickDistance distance;
  voxel::SolidCells cells;
};

/// The product's broad and narrow phase for one bone and one shell, put together as sim does it.
class OurContact {
 public:
  /// `bone` must outlive it.
  /// Probes are a voxel long, as in a session, unless told otherwise (mm).
  OurContact(OurBone& bone, const shell::PointShell& shell, double probe_length_mm = 0.0);

  /// The C++ form, and the OpenCL form on a device; both refer to this object. Without a volume of interest
  /// the whole tool is of interest. A device that fails throws Error unavailable.
  Contender cpu(bool use_voi = true) const;
  Contender opencl(const gpu::Device& device, bool use_voi = true) const;

  const collide::ContactShell& shell() const { return shell_; }

 private:
  Contender contender(const std::string& name, std::shared_ptr<collide::NarrowPhase> phase,
                      bool use_voi) const;
  collide::NarrowPhaseInput input() const;

  OurBone& bone_;
  collide::ContactShell shell_;
};

}  // namespace ream::bench
