#include "isolation/isolated_service.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <vector>

#include "core/error.hpp"
#include "core/json.hpp"
#include "isolation/sandbox.hpp"

namespace ream::isolation {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto between_reports = std::chrono::milliseconds(50);

/// One line of JSON. Text that is no UTF-8, as file names may be, is mended.
void send(const json& message) {
  const std::string line = message.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  for (size_t sent = 0; sent < line.size();) {
    const ssize_t n = ::write(answer_descriptor, line.data() + sent, line.size() - sent);
    if (n <= 0) std::_Exit(EXIT_FAILURE);
    sent += static_cast<size_t>(n);
  }
}

json take_request() {
  std::string text;
  std::array<char, 4096> piece{};
  for (ssize_t n; (n = ::read(request_descriptor, piece.data(), piece.size())) > 0;)
    text.append(piece.data(), static_cast<size_t>(n));
  return parse_json_or_discard(text);
}

/// The path of the input in this process, under its own name, as readers go by endings; what stands for it in
/// messages; and the files that may be read.
struct Input {
  fs::path path;
  std::string inside, given;
  std::vector<int> readable;  ///< open descriptors
};

/// A file in the folder that the process was started with. There may be none of that name, or a folder, of
/// which nothing may be read: who needs it says so.
void open_in_folder(Input& input, const fs::path& name, int how) {
  const int file = ::openat(input_descriptor, name.filename().c_str(), O_RDONLY | O_CLOEXEC | how);
  struct stat status {};
  if (file >= 0 && ::fstat(file, &status) == 0 && S_ISREG(status.st_mode))
    input.readable.push_back(file);
  else if (file >= 0)
    ::close(file);
}

Input open_input(const json& request) {
  const fs::path given = request.at("input").get<std::string>();
  const fs::path neighbour = request.at("neighbour").get<std::string>();
  const fs::path name = given.has_filename() ? given.filename() : fs::path("input");
  const fs::path descriptor = "/proc/self/fd/" + std::to_string(input_descriptor);
  fs::create_directory("input");
  if (!neighbour.empty()) {
    fs::create_symlink(descriptor, "input/folder");
    Input input{fs::path("input/folder") / name, "input/folder/", (given.parent_path() / "").string(), {}};
    open_in_folder(input, name, 0);
    open_in_folder(input, neighbour, O_NOFOLLOW | O_NONBLOCK);
    return input;
  }
  fs::create_symlink(descriptor, "input" / name);
  return {"input" / name, ("input" / name).string(), given.string(), {input_descriptor}};
}

std::string as_given(std::string message, const Input& input) {
  for (size_t at = 0; (at = message.find(input.inside, at)) != std::string::npos; at += input.given.size())
    message.replace(at, input.inside.size(), input.given);
  return message;
}

Progress reporting() {
  return
      [last = Clock::time_point(), last_step = std::string()](double share, std::string_view step) mutable {
        if (Clock::now() - last < between_reports && step == last_step) return;
        last = Clock::now();
        last_step = step;
        send({{"share", share}, {"step", last_step}});
      };
}

json done(const std::map<std::string, IsolatedTask>& tasks, const json& request) {
  const Input input = open_input(request);
  const auto failed = [&](ErrorKind kind, const std::string& words) {
    return json{{"error", as_given(words, input)}, {"kind", static_cast<int>(kind)}};
  };
  try {
    const SandboxLimits limits{request.at("memory_bytes").get<uint64_t>(),
                               request.at("file_bytes").get<uint64_t>(),
                               request.at("processor_s").get<unsigned>(), request.at("compiles").get<bool>(),
                               request.at("background").get<bool>()};
    enter_sandbox(input.readable, output_descriptor, limits);
    return {{"answer", tasks.at(request.at("task"))(input.path, request.at("options"), reporting())}};
  } catch (const Error& error) {
    return failed(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(ErrorKind::invalid_input,
                  input.path.string() + " does not fit into the memory that is free for reading");
  } catch (const std::exception& error) {
    return failed(ErrorKind::invalid_input, input.path.string() + " cannot be read: " + error.what());
  }
}

}  // namespace

void write_values(const std::string& name, std::span<const std::byte> values) {
  std::ofstream out(name, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size()));
  if (!out.flush()) throw Error(ErrorKind::io, "there is no room on the disk for temporary files");
}

void serve_one_job(const std::map<std::string, IsolatedTask>& tasks) {
  if (::fcntl(request_descriptor, F_GETFD) < 0 || ::fcntl(answer_descriptor, F_GETFD) < 0) {
    std::cerr << program_invocation_short_name << " is started by ream; there is nothing to call by hand\n";
    std::_Exit(2);
  }
  const json request = take_request();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const bool orphaned = !request.is_object() || request.value("parent", -1) != ::getppid();
  if (orphaned || ::fchdir(output_descriptor) != 0) std::_Exit(2);
  send(done(tasks, request));
  std::_Exit(EXIT_SUCCESS);
}

}  // namespace ream::isolation
