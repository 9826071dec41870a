#pragma once
#include <pybind11/pybind11.h>

#include <cfenv>
#include <mutex>

#include "core/progress.hpp"

namespace ream::python {

/// Numbers are rounded to the nearest while it lives, whatever another library has set: results are the same
/// bits everywhere.
class PlainNumbers {
 public:
  PlainNumbers() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~PlainNumbers() { std::fesetenv(&before_); }
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

 private:
  std::fenv_t before_;
};

/// For as long as C++ computes: Python's other threads go on. Nothing of Python may be touched.
class Computing {
 public:
  Computing();
  ~Computing();
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;

 private:
  friend class Signals;
  friend class WithinPython;
  /// Into Python. A daemon thread cannot come back when Python ends, as Python would end the thread in the
  /// middle of C++: it waits for the end of the process.
  void come_back();

  PlainNumbers plain_;
  PyThreadState* thread_;
};

/// In the midst of Computing, back in Python for as long as it lives; where nothing computes on this thread,
/// Python is there already.
class WithinPython {
 public:
  WithinPython();
  ~WithinPython();
  WithinPython(const WithinPython&) = delete;
  WithinPython& operator=(const WithinPython&) = delete;

 private:
  Computing* computing_;
};

/// Before anything computes: Python says when it ends.
void watch_end_of_python();

/// Looks for Ctrl-C now and then while Computing.
class Signals {
 public:
  explicit Signals(Computing& computing) : computing_(computing) {}
  /// Throws what a signal's handler has raised, such as KeyboardInterrupt.
  void look();
  /// For long work: looks ten times a second, on the thread that began it.
  Progress progress();

 private:
  Computing& computing_;
};

/// Held while a case is loaded: two threads would make the demo case twice, in one place.
std::mutex& case_mutex();

}  // namespace ream::python
