#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ream::test {

/// A program of its own that runs beside the test, with nothing of the test's environment but `environment`.
/// What it prints goes to files. Killed with its owner. Failures throw std::runtime_error.
class ChildProcess {
 public:
  struct Setting {
    std::vector<std::string> command;  ///< path of the program, then its arguments
    std::map<std::string, std::string> environment;
    std::filesystem::path folder;  ///< it runs in
    std::filesystem::path out, error;
    std::filesystem::path in = "/dev/null";
  };
  explicit ChildProcess(const Setting& setting);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t id() const { return id_; }
  void send_signal(int number) const;
  bool ended();
  /// Its exit code, or 128 + the signal that ended it. Throws when it takes longer.
  int wait(std::chrono::seconds longest);

 private:
  pid_t id_ = -1;
  int exit_code_ = -1;
};

}  // namespace ream::test
