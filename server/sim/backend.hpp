#pragma once
#include <memory>
#include <string>

#include "collide/decay.hpp"
#include "collide/narrow_phase.hpp"
#include "collide/removal.hpp"
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

}  // namespace ream::sim
