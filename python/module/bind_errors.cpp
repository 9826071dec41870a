#include <cstring>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "module/bindings.hpp"

namespace ream::python {
namespace {

namespace py = pybind11;

const char* to_text(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage: return "usage";
    case ErrorKind::invalid_input: return "invalid_input";
    case ErrorKind::not_found: return "not_found";
    case ErrorKind::conflict: return "conflict";
    case ErrorKind::unavailable: return "unavailable";
    case ErrorKind::io: return "io";
    case ErrorKind::cancelled: return "cancelled";
  }
  return "invalid_input";
}

/// Paths in a message may be anything.
void raise(py::handle error, ErrorKind kind, const char* message) {
  const auto text = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(message, static_cast<py::ssize_t>(std::strlen(message)), "replace"));
  if (!text) return;
  const py::object raised = error(text);
  raised.attr("kind") = to_text(kind);
  PyErr_SetObject(error.ptr(), raised.ptr());
}

}  // namespace

void bind_errors(py::module_& module) {
  // It lives as long as the interpreter, as exceptions may be thrown until the end.
  static const py::handle error = py::exception<Error>(module, "Error").release();
  error.attr("__module__") = "ream";
  error.attr("kind") = to_text(ErrorKind::invalid_input);
  error.attr("__doc__") =
      "What ream refuses or cannot do. `kind` is one of usage, invalid_input, not_found, "
      "conflict, unavailable, io, cancelled.";
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const Error& e) {
      raise(error, e.kind(), e.what());
    } catch (const std::filesystem::filesystem_error& e) {
      raise(error, ErrorKind::io, e.what());
    } catch (const nlohmann::json::exception& e) {
      raise(error, ErrorKind::invalid_input, e.what());
    }
  });
}

}  // namespace ream::python
