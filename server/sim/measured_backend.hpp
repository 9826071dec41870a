#pragma once
#include <string>
#include <vector>

#include "sim/backend.hpp"

namespace ream::sim {

/// What a backend took to look for contact and to work through a list of bricks, as a tick does.
struct BackendTiming {
  std::string name;
  double p50_us = 0.0;
  double slow_us = 0.0;  ///< the slowest of a few dozen ticks in a row, as the median of many such rows
  double p999_us = 0.0;
  bool wakes_threads = false;  ///< works on threads that sleep between ticks
  std::string failure;         ///< why it could not be had; empty when it could
};

/// The quicker of two: by its slow ticks, for these are felt; one that must wake threads also has to be
/// better at the 99.9th percentile, for on a busy machine a thread may be woken late.
bool is_quicker(const BackendTiming& a, const BackendTiming& than);

/// The quickest backend on this machine, now: the C++ form and every OpenCL device are tried in turns on this
/// case with the tool pressed on the bone, without changing anything. Takes a fraction of a second a device.
/// `timings` becomes what was measured, in order of trial.
Backend make_measured_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells,
                              std::vector<BackendTiming>& timings);

}  // namespace ream::sim
