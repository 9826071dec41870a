#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace ream::record {

/// Where a log's bytes go: a file, or in tests one that fails. One thread appends; another may sync
/// meanwhile.
class LogSink {
 public:
  virtual ~LogSink() = default;
  /// Appends all of it. Throws Error io naming the file and the cause (a full disk, say); what was written of
  /// it stays.
  virtual void append(std::span<const std::byte> bytes) = 0;
  /// What was appended survives a loss of power from here on. Throws Error io.
  virtual void sync() = 0;
};

/// A new file (which must not exist), or one that goes on after its first `keep_bytes`; what it holds behind
/// them is cut off. A file has one writer at a time: Error conflict while another process holds it. Throws
/// Error io.
std::unique_ptr<LogSink> create_log_file(const std::filesystem::path& path);
std::unique_ptr<LogSink> continue_log_file(const std::filesystem::path& path, uint64_t keep_bytes);

}  // namespace ream::record
