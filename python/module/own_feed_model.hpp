#pragma once
#include <pybind11/pybind11.h>

#include <exception>

#include "force/feed_model.hpp"

namespace ream::python {

/// A feed model that somebody wrote in Python: an object whose `load(bone, thrust_n)` is called in each tick
/// in which the reamer touches, by the thread that computes. docs/python.md describes it.
class OwnFeedModel final : public force::FeedModel {
 public:
  /// `model` as Python has it, `bone_type` makes what its load() is called with: ream.models.EngagedBone.
  OwnFeedModel(pybind11::object model, pybind11::object bone_type);
  ~OwnFeedModel() override;
  OwnFeedModel(const OwnFeedModel&) = delete;
  OwnFeedModel& operator=(const OwnFeedModel&) = delete;

  /// Not a number where Python raised: then throw_raised() says what.
  force::CuttingLoad load(const force::EngagedBone& bone, double thrust_n) const noexcept override;

  /// Whether load() failed. Its numbers may have been used all the same, or not.
  bool has_raised() const noexcept { return raised_ != nullptr; }
  /// Throws once what load() could not; else nothing.
  void throw_raised();

 private:
  force::CuttingLoad asked(const force::EngagedBone& bone, double thrust_n) const;

  pybind11::object load_, bone_type_;
  mutable std::exception_ptr raised_;
};

}  // namespace ream::python
