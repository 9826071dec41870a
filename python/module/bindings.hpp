#pragma once
#include <pybind11/pybind11.h>

/// Each adds its part to the module ream._ream. What they give is for python/ream, which is what people see.
namespace ream::python {

void bind_errors(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_meshes(pybind11::module_& module);

}  // namespace ream::python
