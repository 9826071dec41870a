#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {

struct Outcome {
  int exit_code = -1;
  std::string out, error;
};

/// Runs `ream` in a fresh folder that is also its home and holds its data folder `data`.
class CommandLine : public testing::Test {
 protected:
  using Words = std::vector<std::string>;

  Outcome run(const Words& arguments);
  /// run() with that on stdin.
  Outcome run_with_input(const Words& arguments, const std::string& input);
  /// run() that must succeed.
  Outcome succeed(const Words& arguments);
  /// run() of a --json command that must succeed: what it printed.
  nlohmann::json answer(Words arguments);
  /// Expects that exit code, exactly one line on stderr that names `mentioned`, nothing on stdout, and no
  /// file or folder made or changed.
  void refuse(int exit_code, const std::string& mentioned, const Words& arguments);
  /// refuse() while another program writes to the folder, so that files may change.
  void refuse_beside_others(int exit_code, const std::string& mentioned, const Words& arguments);

  /// Starts a command and lets it run; what it prints goes to <name>.out and <name>.err in printed().
  std::unique_ptr<ChildProcess> start(const Words& arguments, const std::string& name);
  /// The same for any program, given by its path.
  std::unique_ptr<ChildProcess> start_program(const Words& command, const std::string& name);
  std::string printed(const std::string& file) const;

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::filesystem::path write(const std::string& name, const std::string& text) {
    return folder_.write(name, text);
  }
  nlohmann::json json_of(const std::filesystem::path& relative) const;
  std::string text_of(const std::filesystem::path& relative) const;
  /// Writes short.json: three seconds in which the tool touches bone and removes some.
  std::string short_script();
  /// Runs it on the demo case: the folder run. All tests of one build share what the first of them makes.
  void simulate_short_demo();
  /// The demo case is there, as one of all tests made it; a program makes it in seconds where it is not.
  void take_demo_case();
  /// Relative paths of all files and folders with the files' sizes, leaving out caches below home.
  std::vector<std::string> tree() const;

  TemporaryFolder folder_, printed_;
  std::filesystem::path input_ = "/dev/null";       ///< stdin of what is started
  std::map<std::string, std::string> environment_;  ///< more of it
};

}  // namespace ream::test
