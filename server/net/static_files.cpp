#include "net/static_files.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"

namespace ream::net {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse_page(const std::string& path) {
  throw Error(ErrorKind::not_found,
              (path.starts_with("/api/") ? "no such endpoint: " : "no such page: ") + path);
}

/// Relative path without any segment that could lead out of the folder or to a hidden file.
fs::path safe_relative(const std::string& path) {
  fs::path relative;
  for (size_t begin = 1; begin <= path.size();) {
    const size_t end = std::min(path.find('/', begin), path.size());
    const std::string segment = path.substr(begin, end - begin);
    const bool trailing = segment.empty() && end == path.size();
    if (!trailing && (segment.empty() || segment.front() == '.' || segment.find('\0') != std::string::npos))
      refuse_page(path);
    relative /= trailing ? "index.html" : segment;
    begin = end + 1;
  }
  return relative;
}

/// A page may be asked for without the ending of its file, also one that is called as a folder beside it.
fs::path file_of(const fs::path& path) {
  std::error_code failed;
  fs::path page = path;
  page += ".html";
  return !fs::is_regular_file(path, failed) && fs::is_regular_file(page, failed) ? page : path;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  const auto [folder_end, file_at] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return folder_end == folder.end() && file_at != file.end();
}

std::string entity_tag(const fs::path& file, uint64_t size) {
  const auto written = fs::last_write_time(file).time_since_epoch().count();
  return "\"" + to_hex(hash_combine(static_cast<uint64_t>(written), size)) + "\"";
}

}  // namespace

StaticFiles::StaticFiles(fs::path root) : root_(fs::weakly_canonical(root)) {}

Response StaticFiles::respond(const Request& request) const {
  std::error_code failed;
  const fs::path file = fs::weakly_canonical(file_of(root_ / safe_relative(request.path)), failed);
  if (failed || !is_inside(file, root_) || !fs::is_regular_file(file, failed)) refuse_page(request.path);
  const std::string tag = entity_tag(file, fs::file_size(file));
  const bool hashed_name = request.path.rfind("/assets/", 0) == 0;
  Response response;
  response.headers = {{"ETag", tag},
                      {"Cache-Control", hashed_name ? "public, max-age=31536000, immutable" : "no-cache"}};
  if (request.header("if-none-match").find(tag) != std::string_view::npos) {
    response.status = 304;
    return response;
  }
  response.content_type = content_type_of(file);
  response.body = std::make_shared<const Bytes>(read_binary_file(file));
  return response;
}

std::string content_type_of(const fs::path& file) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 18> types = {{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".webp", "image/webp"},
      {".ico", "image/x-icon"},
      {".wasm", "application/wasm"},
      {".woff2", "font/woff2"},
      {".txt", "text/plain; charset=utf-8"},
      {".glb", "model/gltf-binary"},
      {".wav", "audio/wav"},
      {".pdf", "application/pdf"},
  }};
  const std::string extension = file.extension().string();
  for (const auto& [known, type] : types)
    if (extension == known) return std::string(type);
  return "application/octet-stream";
}

}  // namespace ream::net
