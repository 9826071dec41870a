#include "module/own_feed_model.hpp"

#include <cxxabi.h>
#include <unistd.h>

#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "module/computing.hpp"

namespace ream::python {

namespace py = pybind11;

namespace {

py::tuple triple(const std::array<double, 3>& numbers) {
  return py::make_tuple(numbers[0], numbers[1], numbers[2]);
}

double number(const py::handle& value, const char* name, double least) {
  const double found = PyFloat_AsDouble(value.ptr());
  if (found == -1.0 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (!std::isfinite(found) || found < least)
    throw Error(ErrorKind::invalid_input, std::string("the feed model's ") + name + " is " +
                                              std::to_string(found) + "; it must be finite and at least " +
                                              std::to_string(least));
  return found;
}

/// Slower than any feed that a tick can move.
constexpr double min_resistance_n_s_mm = 1e-3;

}  // namespace

OwnFeedModel::OwnFeedModel(py::object model, py::object bone_type)
    : load_(model.attr("load")), bone_type_(std::move(bone_type)) {
  if (PyCallable_Check(load_.ptr()) == 0)
    throw Error(ErrorKind::usage, "a feed model's `load` must be a function of (bone, thrust_n)");
}

/// It may go on any thread that holds the interpreter, or after it.
OwnFeedModel::~OwnFeedModel() {
  const WithinPython python;
  load_ = py::object();
  bone_type_ = py::object();
  raised_ = nullptr;
}

force::CuttingLoad OwnFeedModel::load(const force::EngagedBone& bone, double thrust_n) const noexcept {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (raised_) return {none, none};
  const WithinPython python;
  try {
    return asked(bone, thrust_n);
  } catch (const abi::__forced_unwind&) {
    // Python ends, and with it this thread, which must not be unwound through what does not throw.
    while (true) ::pause();
  } catch (...) {
    raised_ = std::current_exception();
    return {none, none};
  }
}

force::CuttingLoad OwnFeedModel::asked(const force::EngagedBone& bone, double thrust_n) const {
  const py::object given = load_(bone_type_(triple(bone.share), triple(bone.density_g_cc), bone.area_mm2,
                                            bone.edge_mm, bone.mean_density_g_cc()),
                                 thrust_n);
  if (!py::isinstance<py::tuple>(given))
    return {number(given, "resistance_n_s_mm", min_resistance_n_s_mm), 0.0};
  const auto parts = py::reinterpret_borrow<py::tuple>(given);
  if (parts.empty() || parts.size() > 3)
    throw Error(
        ErrorKind::invalid_input,
        "a feed model gives (resistance_n_s_mm, torque_arm_mm, tangential_ratio), or the first of them");
  return {number(parts[0], "resistance_n_s_mm", min_resistance_n_s_mm),
          parts.size() > 1 ? number(parts[1], "torque_arm_mm", 0.0) : 0.0,
          parts.size() > 2 ? number(parts[2], "tangential_ratio", 0.0) : 0.0};
}

void OwnFeedModel::throw_raised() {
  if (raised_) std::rethrow_exception(std::exchange(raised_, nullptr));
}

}  // namespace ream::python
