#include "module/bindings.hpp"
#include "module/computing.hpp"
#include "module/tick_rows.hpp"

PYBIND11_MODULE(_ream, module) {
  module.attr("version") = REAM_VERSION;
  ream::python::watch_end_of_python();
  ream::python::bind_errors(module);
  module.attr("tick_dtype") = ream::python::make_tick_dtype();
  ream::python::bind_simulation(module);
  ream::python::bind_recording(module);
  ream::python::bind_meshes(module);
}
