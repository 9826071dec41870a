#include "e2e/cli/command_line.hpp"

#include <unistd.h>

#include <algorithm>

#include "core/file.hpp"
#include "support/places.hpp"

namespace ream::test {
namespace {

namespace fs = std::filesystem;

constexpr auto longest_run = std::chrono::seconds(240);
constexpr const char* demo_case = "data/cases/demo";

/// Of this build of the program.
fs::path kept_demo() {
  const fs::path program = build_folder() + "/ream";
  const auto made = fs::last_write_time(program).time_since_epoch().count();
  return build_folder() + "/tests/short-demo-" + std::to_string(made);
}

void copy_folder(const std::string& name, const fs::path& from, const fs::path& to) {
  fs::create_directories((to / name).parent_path());
  fs::copy(from / name, to / name, fs::copy_options::recursive);
}
void copy_demo(const fs::path& from, const fs::path& to) {
  for (const char* name : {demo_case, "run"}) copy_folder(name, from, to);
}

/// Another test may do the same. Those of earlier builds go.
void keep_demo(const fs::path& from) {
  const fs::path kept = kept_demo(), half = kept.string() + "." + std::to_string(::getpid());
  for (const auto& entry : fs::directory_iterator(kept.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("short-demo-") && !name.starts_with(kept.filename().string()))
      fs::remove_all(entry.path());
  }
  fs::create_directories(half);
  copy_demo(from, half);
  std::error_code other_was_first;
  fs::rename(half, kept, other_was_first);
  fs::remove_all(half);
}

}  // namespace

std::unique_ptr<ChildProcess> CommandLine::start(const Words& arguments, const std::string& name) {
  Words command = {build_folder() + "/ream"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return start_program(command, name);
}

std::unique_ptr<ChildProcess> CommandLine::start_program(const Words& command, const std::string& name) {
  ChildProcess::Setting setting;
  setting.command = command;
  const fs::path home = printed_.path() / "home";
  fs::create_directories(home);
  setting.environment = {{"HOME", home.string()},
                         {"REAM_DATA", (folder() / "data").string()},
                         {"PATH", "/usr/bin:/bin"},
                         // Graphics and OpenCL libraries keep memory of their own until the end.
                         {"ASAN_OPTIONS", "detect_leaks=0"}};
  setting.environment.insert(environment_.begin(), environment_.end());
  setting.folder = folder();
  setting.out = printed_.path() / (name + ".out");
  setting.error = printed_.path() / (name + ".err");
  setting.in = input_;
  for (const fs::path& file : {setting.out, setting.error}) write_file_atomically(file, std::string_view());
  return std::make_unique<ChildProcess>(setting);
}

std::string CommandLine::printed(const std::string& file) const {
  return read_text_file(printed_.path() / file);
}

Outcome CommandLine::run(const Words& arguments) {
  Outcome outcome;
  outcome.exit_code = start(arguments, "run")->wait(longest_run);
  outcome.out = printed("run.out");
  outcome.error = printed("run.err");
  return outcome;
}

Outcome CommandLine::run_with_input(const Words& arguments, const std::string& input) {
  input_ = printed_.write("run.in", input);
  Outcome outcome = run(arguments);
  input_ = "/dev/null";
  return outcome;
}

Outcome CommandLine::succeed(const Words& arguments) {
  Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << testing::PrintToString(arguments) << '\n' << outcome.error;
  return outcome;
}

nlohmann::json CommandLine::answer(Words arguments) {
  arguments.push_back("--json");
  const Outcome outcome = succeed(arguments);
  nlohmann::json json = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << outcome.out;
  return json;
}

void CommandLine::refuse(int exit_code, const std::string& mentioned, const Words& arguments) {
  const auto before = tree();
  refuse_beside_others(exit_code, mentioned, arguments);
  EXPECT_EQ(tree(), before) << testing::PrintToString(arguments);
}

void CommandLine::refuse_beside_others(int exit_code, const std::string& mentioned, const Words& arguments) {
  SCOPED_TRACE("ream " + testing::PrintToString(arguments));
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.error;
  const bool for_programs = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  EXPECT_TRUE(outcome.error.starts_with(for_programs ? R"({"error":")" : "ream: ")) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  EXPECT_TRUE(outcome.error.ends_with('\n'));
  EXPECT_NE(outcome.error.find(mentioned), std::string::npos)
      << outcome.error << "does not name " << mentioned;
  EXPECT_EQ(outcome.out, "");
}

nlohmann::json CommandLine::json_of(const fs::path& relative) const {
  return read_json_file(folder() / relative);
}

std::string CommandLine::text_of(const fs::path& relative) const {
  return read_text_file(folder() / relative);
}

std::string CommandLine::short_script() {
  return write("short.json",
               R"({"device": "hand", "duration_s": 3, "stiffness_n_mm": 100, "vibration": {"source": "off"},
                   "hand": {"start_mm": [0, 0, -1],
                            "force_profile": [{"t_s": 0, "force_n": 30}, {"t_s": 0.3, "force_n": 60}]}})")
      .filename();
}

void CommandLine::simulate_short_demo() {
  const std::string script = short_script();
  if (fs::exists(kept_demo())) return copy_demo(kept_demo(), folder());
  succeed({"simulate", "--case", "demo", "--script", script, "--backend", "cpu", "--out", "run"});
  keep_demo(folder());
}

void CommandLine::take_demo_case() {
  if (fs::exists(kept_demo())) {
    copy_folder(demo_case, kept_demo(), folder());
    fs::permissions(folder() / "data", fs::perms::owner_all);  // as a program makes it
    return;
  }
  simulate_short_demo();
  for (const char* made : {"run", "short.json"}) fs::remove_all(folder() / made);
}

std::vector<std::string> CommandLine::tree() const {
  std::vector<std::string> entries;
  for (const auto& entry : fs::recursive_directory_iterator(folder()))
    entries.push_back(entry.path().lexically_relative(folder()).string() +
                      (entry.is_regular_file() ? " " + std::to_string(entry.file_size()) : "/"));
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace ream::test
