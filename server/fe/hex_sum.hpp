#pragma once
#include <limits>

#include "fe/mesh_check.hpp"

namespace ream::fe {

/// Adds up elements one by one.
class HexSum {
 public:
  explicit HexSum(ElementVisitor visit) : visit_(std::move(visit)) {}

  /// False when its Jacobian is not positive at every corner.
  bool add(const HexCorners& corners);
  double volume_mm3() const { return volume_mm3_; }
  double least_jacobian_mm3() const { return least_mm3_; }

 private:
  ElementVisitor visit_;
  double volume_mm3_ = 0.0, least_mm3_ = std::numeric_limits<double>::infinity();
};

}  // namespace ream::fe
