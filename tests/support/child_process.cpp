#include "support/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace ream::test {
namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Only what is allowed between fork and exec.
[[noreturn]] void become(const ChildProcess::Setting& setting, char* const* command,
                         char* const* environment) {
  const int in = ::open(setting.in.c_str(), O_RDONLY | O_NOCTTY);
  const int out = ::open(setting.out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int error = ::open(setting.error.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (::dup2(in, 0) == 0 && ::dup2(out, 1) == 1 && ::dup2(error, 2) == 2 &&
      ::chdir(setting.folder.c_str()) == 0)
    ::execve(command[0], command, environment);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const Setting& setting) {
  std::vector<std::string> command = setting.command, environment;
  for (const auto& [name, value] : setting.environment) environment.push_back(name + "=" + value);
  const std::vector<char*> arguments = pointers(command), variables = pointers(environment);
  id_ = ::fork();
  if (id_ < 0) throw std::runtime_error("cannot start " + setting.command[0]);
  if (id_ == 0) become(setting, arguments.data(), variables.data());
}

ChildProcess::~ChildProcess() {
  if (ended()) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

void ChildProcess::send_signal(int number) const {
  if (exit_code_ < 0) ::kill(id_, number);
}

bool ChildProcess::ended() {
  int status = 0;
  if (exit_code_ < 0 && ::waitpid(id_, &status, WNOHANG) == id_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_ >= 0;
}

int ChildProcess::wait(std::chrono::seconds longest) {
  const auto latest = std::chrono::steady_clock::now() + longest;
  while (!ended()) {
    if (std::chrono::steady_clock::now() > latest)
      throw std::runtime_error("the program has not ended within " + std::to_string(longest.count()) + " s");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return exit_code_;
}

}  // namespace ream::test
