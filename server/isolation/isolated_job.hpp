#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "core/temporary_file.hpp"

namespace ream::isolation {

/// Also a process that only sleeps ends after this; one that works is ended by its processor time long
/// before.
inline constexpr std::chrono::hours max_isolated_time{2};

inline constexpr const char *reader_name = "ream-reader", *renderer_name = "ream-renderer";
/// A program of ours beside the one that runs, or where that is installed in bin, in lib/ream beside bin. It
/// may not be there.
std::filesystem::path helper_program(const std::string& name);

/// What one run may use.
struct IsolatedLimits {
  uint64_t memory_bytes = 0;  ///< of address space; 0: three quarters of what this machine has free
  uint64_t file_bytes = uint64_t{16} << 30;  ///< of each file that it writes
  unsigned processor_s = 1800;
  std::chrono::milliseconds time = max_isolated_time;
  /// Of the disk that it writes to, where recordings lie, too; 0: 1 GiB, or a tenth of a small disk.
  uint64_t least_free_bytes = 0;
  bool compiles = false;   ///< makes code while it runs, as a driver does for its shaders
  bool background = true;  ///< runs only when nothing else wants the processor
};

/// How it is told that a job has failed.
struct IsolatedWords {
  std::string worker = "the reader";
  std::string failure = {};  ///< "the picture cannot be drawn"; empty: that the input cannot be read
  std::string hint = "; it may be damaged, or not what its name says";
  ErrorKind kind = ErrorKind::invalid_input;
};

/// A file, and what is to be made of it.
struct IsolatedJob {
  std::filesystem::path program = {};  ///< empty: ream-reader's
  std::string task;                    ///< a name that it knows
  std::filesystem::path input;         ///< a file or a folder
  std::string neighbour = {};  ///< name of a file in the same folder that may be read, too; empty: none
  nlohmann::json options = nlohmann::json::object();
  IsolatedLimits limits;
  std::filesystem::path scratch;  ///< folder for what it writes; empty: the system's for temporary files
  IsolatedWords words = {};
};

/// What it answered. The files that it wrote go away with this object. Both come from a process that a file
/// may have taken over: check every number before it is used.
class IsolatedResult {
 public:
  IsolatedResult(nlohmann::json answer, std::unique_ptr<TemporaryFolder> folder)
      : answer_(std::move(answer)), folder_(std::move(folder)) {}

  const nlohmann::json& answer() const { return answer_; }
  /// A regular file directly in the output folder. Throws Error io when there is no such file.
  std::filesystem::path file(const std::string& name) const;
  /// What such a file holds, as this machine has it in memory; at most `max_bytes`. Throws Error io for more,
  /// or for a part of a value.
  template <typename Value>
  std::vector<Value> values(const std::string& name, uint64_t max_bytes) const {
    static_assert(std::is_standard_layout_v<Value>);
    std::vector<Value> all(count_in(name, sizeof(Value), max_bytes));
    read(name, std::as_writable_bytes(std::span(all)));
    return all;
  }
  /// Throws Error io unless such a file is so long.
  void require_bytes(const std::string& name, uint64_t bytes) const;
  const std::filesystem::path& folder() const { return folder_->path(); }

 private:
  size_t count_in(const std::string& name, size_t value_bytes, uint64_t max_bytes) const;
  void read(const std::string& name, std::span<std::byte> into) const;

  nlohmann::json answer_;
  std::unique_ptr<TemporaryFolder> folder_;
};

/// Does a job in a process of its own, such as the program ream-reader, which sees nothing but the input and
/// an empty folder (sandbox.hpp). Waits for it; the process ends with this call, also when `progress` throws.
/// Errors: not_found; what the process says, one line; the kind of the job's words when it crashed or went
/// beyond its limits; io when it cannot be started.
IsolatedResult run_isolated(const IsolatedJob& job, const Progress& progress = no_progress);

}  // namespace ream::isolation
