#include "isolation/isolated_job.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/statvfs.h>
#include <sys/sysinfo.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "core/file_descriptor.hpp"
#include "core/json.hpp"
#include "core/temporary_file.hpp"
#include "core/text.hpp"
#include "isolation/isolated_service.hpp"

namespace ream::isolation {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr int look_every_ms = 100;
constexpr auto ending_takes = std::chrono::seconds(2);
constexpr int max_output_depth = 32;
constexpr uint64_t usual_least_free_bytes = uint64_t{1} << 30;
constexpr size_t max_request_bytes = 32768, max_answer_bytes = 1 << 20, max_words = 1000;

fs::path program_of(const IsolatedJob& job) {
  return job.program.empty() ? helper_program(reader_name) : job.program;
}

Error cannot_start(const std::string& why) {
  return {ErrorKind::io, "a process of its own cannot be started: " + why};
}

/// Out of the way of the descriptors that the process is given.
FileDescriptor moved_up(int descriptor) {
  FileDescriptor moved(::fcntl(descriptor, F_DUPFD_CLOEXEC, answer_descriptor + 1));
  if (!moved) throw cannot_start(std::strerror(errno));
  return moved;
}

FileDescriptor opened(const fs::path& path, int how = O_RDONLY) {
  FileDescriptor file(::open(path.c_str(), how | O_CLOEXEC | O_NOCTTY));
  if (!file) throw Error(ErrorKind::io, "cannot read " + path.string() + ": " + std::strerror(errno));
  return moved_up(file.get());
}

struct Pipe {
  FileDescriptor out, in;
};

Pipe new_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw cannot_start(std::strerror(errno));
  const FileDescriptor out(ends[0]), in(ends[1]);
  return {moved_up(ends[0]), moved_up(ends[1])};
}

/// A running program; ends with this object.
class Child {
 public:
  Child(const fs::path& program, int input, int output, int requests, int answers) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&attributes);
    for (int standard = 0; standard < 3; ++standard)
      ::posix_spawn_file_actions_addopen(&actions, standard, "/dev/null", O_RDWR, 0);
    ::posix_spawn_file_actions_adddup2(&actions, input, input_descriptor);
    ::posix_spawn_file_actions_adddup2(&actions, output, output_descriptor);
    ::posix_spawn_file_actions_adddup2(&actions, requests, request_descriptor);
    ::posix_spawn_file_actions_adddup2(&actions, answers, answer_descriptor);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, answer_descriptor + 1);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes,
                               POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSID);
    std::string name = program.string();
    std::array<char*, 2> arguments{name.data(), nullptr};
    // Nothing of ours. Large pages, where the kernel gives them on request, take a fifth off the time of a
    // picture.
    std::string large_pages = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1";
    std::array<char*, 2> environment{large_pages.data(), nullptr};
    const int failed =
        ::posix_spawn(&id_, name.c_str(), &actions, &attributes, arguments.data(), environment.data());
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
    if (failed != 0) id_ = -1;
    if (failed != 0) throw cannot_start(name + ": " + std::strerror(failed));
  }
  ~Child() { ended(std::chrono::seconds(0)); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its status as waitpid says it; what still runs after `timeout` is ended.
  int ended(std::chrono::milliseconds timeout) {
    int status = 0;
    const auto latest = std::chrono::steady_clock::now() + timeout;
    while (id_ > 0 && ::waitpid(id_, &status, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() >= latest) {
        ::kill(id_, SIGKILL);
        ::waitpid(id_, &status, 0);
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    id_ = -1;
    return status;
  }

 private:
  pid_t id_ = -1;
};

uint64_t free_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string key, rest; in >> key && std::getline(in, rest);)
    if (key == "MemAvailable:") return std::stoull(rest) * 1024;
  struct sysinfo info {};
  ::sysinfo(&info);
  return uint64_t{info.freeram} * info.mem_unit;
}

void send_request(const FileDescriptor& to, const IsolatedJob& job) {
  const uint64_t memory = job.limits.memory_bytes > 0 ? job.limits.memory_bytes : free_memory() / 4 * 3;
  const std::string text = json{
      {"task", job.task},
      {"input", job.input.string()},
      {"neighbour", job.neighbour},
      {"options", job.options},
      {"memory_bytes", memory},
      {"file_bytes", job.limits.file_bytes},
      {"processor_s", job.limits.processor_s},
      {"compiles", job.limits.compiles},
      {"background", job.limits.background},
      {"parent", ::getpid()}}.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > max_request_bytes || ::write(to.get(), text.data(), text.size()) < 0)
    throw cannot_start("the job has too many words");
}

/// Nothing where it is no object.
json parsed(const std::string& line) {
  json message = parse_json_or_discard(line);
  return message.is_object() ? message : json::object();
}

std::string failure_words(const IsolatedJob& job) {
  return job.words.failure.empty() ? job.input.string() + " cannot be read" : job.words.failure;
}

Error failure_of(const IsolatedJob& job, const std::string& why) {
  return {job.words.kind, failure_words(job) + ": " + why + job.words.hint};
}

/// What the process says, line by line, until its answer or its end (null).
class Answers {
 public:
  /// `output`: the folder that it writes to.
  Answers(const FileDescriptor& from, const FileDescriptor& output, const Progress& progress)
      : from_(from), output_(output), progress_(progress) {}

  json wait(const IsolatedJob& job) {
    const auto latest = std::chrono::steady_clock::now() + job.limits.time;
    while (std::chrono::steady_clock::now() < latest) {
      require_space(job);
      pollfd waiting{from_.get(), POLLIN, 0};
      if (::poll(&waiting, 1, look_every_ms) <= 0) {
        progress_(share_, step_);
        continue;
      }
      std::array<char, 65536> piece{};
      const ssize_t n = ::read(from_.get(), piece.data(), piece.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0 || text_.size() > max_answer_bytes) return {};
      text_.append(piece.data(), static_cast<size_t>(n));
      if (json answer = whole_lines(); !answer.is_null()) return answer;
    }
    throw failure_of(
        job, job.words.worker + " did not answer within " +
                 std::to_string(std::chrono::ceil<std::chrono::seconds>(job.limits.time).count()) + " s");
  }

 private:
  void require_space(const IsolatedJob& job) const {
    struct statvfs system {};
    if (::fstatvfs(output_.get(), &system) != 0 || system.f_blocks == 0) return;
    const uint64_t tenth = uint64_t{system.f_blocks} * system.f_frsize / 10;
    const uint64_t least = job.limits.least_free_bytes > 0 ? job.limits.least_free_bytes
                                                           : std::min(usual_least_free_bytes, tenth);
    if (uint64_t{system.f_bavail} * system.f_frsize < least)
      throw Error(ErrorKind::io, failure_words(job) + ": the disk for temporary files is nearly full");
  }

  json whole_lines() {
    for (size_t end; (end = text_.find('\n')) != std::string::npos;) {
      const json message = parsed(text_.substr(0, end));
      text_.erase(0, end + 1);
      if (message.contains("answer") || message.contains("error")) return message;
      if (const auto share = message.find("share"); share != message.end() && share->is_number())
        share_ = std::clamp(share->get<double>(), share_, 1.0);
      if (const auto step = message.find("step"); step != message.end() && step->is_string())
        step_ = one_line(step->get<std::string>(), max_words);
      progress_(share_, step_);
    }
    return {};
  }

  const FileDescriptor &from_, &output_;
  const Progress& progress_;
  std::string text_, step_ = "reading";
  double share_ = 0.0;
};

Error what_ended_it(const IsolatedJob& job, int status) {
  const std::string& worker = job.words.worker;
  std::string why = worker + " ended without an answer";
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    why = signal == SIGXCPU
              ? "it took more than " + std::to_string(job.limits.processor_s) + " s of processor time"
          : signal == SIGXFSZ ? "what is in it is larger than is taken"
          : signal == SIGKILL ? worker + " had to be ended, as memory ran out or it answered without end"
                              : worker + " crashed on it (" + ::strsignal(signal) + ")";
  }
  return failure_of(job, why);
}

/// What it wrote is files and folders, so that no name below leads elsewhere or waits for somebody. The links
/// to its input, which it makes before it is closed off, are taken away.
void check_output(const fs::path& folder) {
  std::error_code failed;
  remove_tree(folder / "input");
  for (fs::recursive_directory_iterator next(folder, failed), end; !failed && next != end;
       next.increment(failed)) {
    if (next.depth() > max_output_depth)
      throw Error(ErrorKind::io, "a process of its own wrote folders that lie too deep");
    const fs::file_type type = next->symlink_status(failed).type();
    if (!failed && type != fs::file_type::regular && type != fs::file_type::directory)
      throw Error(ErrorKind::io, "a process of its own wrote something that is neither a file nor a folder");
  }
  if (failed)
    throw Error(ErrorKind::io, "what a process of its own wrote cannot be looked at: " + failed.message());
}

ErrorKind kind_of(const json& message) {
  const auto kind = message.find("kind");
  if (kind == message.end() || !kind->is_number_unsigned()) return ErrorKind::invalid_input;
  const auto value = kind->get<uint64_t>();
  return value <= static_cast<uint64_t>(ErrorKind::io) ? static_cast<ErrorKind>(value)
                                                       : ErrorKind::invalid_input;
}

/// The program that this code is in, or Python's module (python/).
fs::path own_file() {
  std::error_code failed;
  Dl_info found{};
  ::dladdr(reinterpret_cast<const void*>(&helper_program), &found);
  const fs::path file = found.dli_fname == nullptr ? "" : found.dli_fname;
  return file.extension() == ".so" ? fs::absolute(file, failed) : fs::read_symlink("/proc/self/exe", failed);
}

}  // namespace

fs::path helper_program(const std::string& name) {
  std::error_code failed;
  const fs::path folder = own_file().parent_path();
  const fs::path installed = folder.parent_path() / "lib/ream" / name;
  return folder.filename() == "bin" && fs::exists(installed, failed) ? installed : folder / name;
}

fs::path IsolatedResult::file(const std::string& name) const {
  const fs::path path = folder_->path() / name;
  std::error_code failed;
  if (!fs::is_regular_file(fs::symlink_status(path, failed)))
    throw Error(ErrorKind::io, "a process of its own answered without writing " + name);
  return path;
}

size_t IsolatedResult::count_in(const std::string& name, size_t value_bytes, uint64_t max_bytes) const {
  const uint64_t bytes = fs::file_size(file(name));
  if (bytes > max_bytes || bytes % value_bytes != 0)
    throw Error(ErrorKind::io, "a process of its own wrote " + std::to_string(bytes) + " bytes of " + name +
                                   ", which cannot be");
  return bytes / value_bytes;
}

void IsolatedResult::require_bytes(const std::string& name, uint64_t bytes) const {
  if (const uint64_t written = fs::file_size(file(name)); written != bytes)
    throw Error(ErrorKind::io, "a process of its own wrote " + std::to_string(written) + " bytes of " + name +
                                   ", but its answer needs " + std::to_string(bytes));
}

void IsolatedResult::read(const std::string& name, std::span<std::byte> into) const {
  const FileDescriptor in(::open(file(name).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  if (!in || in.read_at(0, into) != static_cast<ssize_t>(into.size()))
    throw Error(ErrorKind::io, "what a process of its own wrote as " + name + " cannot be read");
}

IsolatedResult run_isolated(const IsolatedJob& job, const Progress& progress) {
  std::error_code failed;
  if (!fs::exists(job.input, failed))
    throw Error(ErrorKind::not_found, "no such file or folder: " + job.input.string());
  // A folder is only passed through: this descriptor lists no names.
  const FileDescriptor input = job.neighbour.empty()
                                   ? opened(job.input)
                                   : opened(fs::absolute(job.input).parent_path(), O_PATH | O_DIRECTORY);
  auto folder = std::make_unique<TemporaryFolder>(
      job.scratch.empty() ? fs::temp_directory_path() / "ream-read" : job.scratch / ".ream-read");
  const FileDescriptor output = opened(folder->path());
  Pipe requests = new_pipe(), answers = new_pipe();
  Child child(program_of(job), input.get(), output.get(), requests.out.get(), answers.in.get());
  send_request(requests.in, job);  // a pipe takes it whole
  requests = {{}, {}};
  answers.in = {};
  const json message = Answers(answers.out, output, progress).wait(job);
  if (const auto error = message.find("error"); error != message.end() && error->is_string())
    throw Error(kind_of(message), one_line(error->get<std::string>(), max_words));
  if (!message.contains("answer")) throw what_ended_it(job, child.ended(ending_takes));
  child.ended(std::chrono::seconds(0));  // from here on nobody changes what it wrote
  check_output(folder->path());
  return {message["answer"], std::move(folder)};
}

}  // namespace ream::isolation
