#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/file_descriptor.hpp"
#include "net/message.hpp"

namespace ream::net {

/// A file held open. What was opened stays readable when another takes its name, or it is removed.
class OpenFile {
 public:
  /// Throws Error: not_found when there is no such file, invalid_input when it is a folder, io otherwise.
  explicit OpenFile(const std::filesystem::path& path);

  /// When it was opened.
  uint64_t bytes() const { return bytes_; }
  /// Strong entity tag: another one after every change of the file.
  const std::string& tag() const { return tag_; }

  /// Fills `into` from `offset` on; fewer bytes only at the end of the file. From any thread. Throws Error
  /// io.
  size_t read(uint64_t offset, std::span<std::byte> into) const;

 private:
  const std::filesystem::path path_;
  FileDescriptor file_;
  uint64_t bytes_ = 0;
  std::string tag_;
};

/// What of a file goes out, and as what.
struct FileBody {
  std::filesystem::path path;
  std::string content_type;
  std::string download_name;  ///< a browser saves it under this name; empty: it is shown
};

/// The file with its ETag, never whole in memory: 200, or 206 and 416 for one Range (with If-Range), or 304
/// for If-None-Match. Several ranges at once are answered with the whole file. A browser may keep it, but
/// asks again each time. Errors are those of OpenFile.
Response file_response(const Request& request, const FileBody& body);

/// Value of Content-Disposition: saved under `name`, which may hold any letters (RFC 6266).
std::string attachment_named(const std::string& name);

/// What a Range header asks of a body.
struct ByteRange {
  enum class Answer {
    whole,          ///< there is no range that is understood: all of it (200)
    part,           ///< `bytes` from `offset` (206)
    unsatisfiable,  ///< nothing of it exists (416)
  };
  Answer answer = Answer::whole;
  uint64_t offset = 0, bytes = 0;
};

/// Reads "bytes=0-99", "bytes=100-" or "bytes=-100" (RFC 9110, 14.1.2) for a body of `size` bytes. Other
/// units, several ranges and what is not understood ask for the whole.
ByteRange read_range(std::string_view header, uint64_t size);

}  // namespace ream::net
