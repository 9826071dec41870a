#include "module/computing.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

namespace ream::python {

namespace {

std::atomic<bool> python_ends{false};
std::thread::id ending_thread;  ///< set before python_ends
/// Threads that are on their way into Python.
std::atomic<int> coming_back{0};
/// Threads that are in Python in the midst of computing.
std::atomic<int> within{0};
/// What computes on this thread, and has left Python.
thread_local Computing* computing_here = nullptr;

/// Called by Python on the thread that ends it, while daemon threads still run.
void say_that_python_ends() {
  ending_thread = std::this_thread::get_id();
  python_ends = true;
  const pybind11::gil_scoped_release let_them_in;
  // Those within Python come out in a moment, if they do: what they call may never return.
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while (coming_back > 0 || (within > 0 && std::chrono::steady_clock::now() < until))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

void watch_end_of_python() {
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(&say_that_python_ends));
}

Computing::Computing() : thread_(PyEval_SaveThread()) { computing_here = this; }

Computing::~Computing() {
  come_back();
  computing_here = nullptr;
}

WithinPython::WithinPython() : computing_(std::exchange(computing_here, nullptr)) {
  if (computing_ == nullptr) return;
  ++within;
  computing_->come_back();
}

WithinPython::~WithinPython() {
  if (computing_ == nullptr) return;
  computing_->thread_ = PyEval_SaveThread();
  computing_here = computing_;
  --within;
}

void Computing::come_back() {
  ++coming_back;
  if (python_ends && std::this_thread::get_id() != ending_thread) {
    --coming_back;
    if (computing_here != this) --within;
    while (true) ::pause();
  }
  PyEval_RestoreThread(thread_);
  --coming_back;
}

void Signals::look() {
  computing_.come_back();
  const bool raised = PyErr_CheckSignals() != 0;
  if (!raised) {
    computing_.thread_ = PyEval_SaveThread();
    return;
  }
  pybind11::error_already_set error;
  computing_.thread_ = PyEval_SaveThread();
  throw error;
}

Progress Signals::progress() {
  static constexpr std::chrono::milliseconds between{100};
  const auto owner = std::this_thread::get_id();
  return [this, owner, next = std::chrono::steady_clock::now() + between](double, std::string_view) mutable {
    if (std::this_thread::get_id() != owner || std::chrono::steady_clock::now() < next) return;
    next = std::chrono::steady_clock::now() + between;
    look();
  };
}

std::mutex& case_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace ream::python
