#pragma once
#include <pybind11/numpy.h>

#include <vector>

#include "geometry/pose.hpp"
#include "record/recording.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::python {

/// The NumPy type of a row of ticks: the fields of proto/recording.json's tick, a pose as rotation_q30 (9)
/// and translation_nm (3). Called once, before tick_array(), by the module's beginning.
pybind11::dtype make_tick_dtype();

/// A NumPy array that owns the rows.
pybind11::array tick_array(std::vector<record::ops::Tick> rows);

/// What trace.csv has of them (record::trace_columns): an array of doubles for each column, by name.
/// `removed`: coverage levels that ticks before them had removed.
pybind11::dict trace_arrays(const std::vector<record::ops::Tick>& rows, const voxel::VoxelGrid& grid,
                            const Pose& world_from_plan, int64_t removed);
/// The rows of such an array once more. Error invalid_input for another type.
std::vector<record::ops::Tick> ticks_from(const pybind11::array& rows);

}  // namespace ream::python
