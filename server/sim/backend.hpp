#pragma once
#include <memory>
#include <string>
#include <vector>

#include "collide/contact/narrow_phase.hpp"
#include "collide/removal/decay.hpp"
#include "collide/removal/removal.hpp"
#include "gpu/device.hpp"
#include "sim/model.hpp"

namespace ream::sim {

/// The parts of the tick that exist in C++ and in OpenCL, with the same bits. Of removal and decay there is
/// the one that the settings ask for.
struct Backend {
  std::string name;    ///< for people: "cpu", or "opencl: <device>"
  std::string choice;  ///< for people: what it was chosen from and why, when that was left to the program
  std::unique_ptr<collide::NarrowPhase> narrow_phase;
  std::unique_ptr<collide::Removal> removal;
  std::unique_ptr<collide::Decay> decay;
};

/// `model.settings.backend`: "cpu" is the C++ form, "opencl" or "opencl:N" an OpenCL device, "auto" the one
/// that measures best (sim/measured_backend.hpp). Everything is allocated, built and warmed here. Errors:
/// usage for other words, unavailable when the device cannot be had.
Backend make_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells);

/// The OpenCL form on a device. Errors: unavailable.
Backend make_opencl_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells,
                            const gpu::Device& device);

/// The C++ form. It cannot fail in a tick.
Backend make_cpp_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells);

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
