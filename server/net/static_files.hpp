#pragma once
#include <filesystem>
#include <string>

#include "net/message.hpp"

namespace ream::net {

/// Serves the files of one folder, never anything outside it (".." and hidden names are refused, links that
/// lead out as well). "/" is index.html, and "/x" is x.html where there is no file x. With ETag; files under
/// /assets/ carry their hash in the name and are cached for a year, all others are asked for again.
class StaticFiles {
 public:
  explicit StaticFiles(std::filesystem::path root);

  /// 200, or 304 when the peer's copy is current. Throws Error not_found.
  Response respond(const Request& request) const;

 private:
  std::filesystem::path root_;
};

/// Content type of a file by its extension; application/octet-stream when unknown.
std::string content_type_of(const std::filesystem::path& file);

}  // namespace ream::net
