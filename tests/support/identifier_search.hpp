#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ream::test {

/// Looks for words in bytes as text, in UTF-16 of either order, URL-encoded and in Base64, also within what
/// the bytes hold packed: zip members, gzip and zlib streams and zstd frames, wherever they begin, and those
/// within them.
class IdentifierSearch {
 public:
  /// Looked for without regard to case; `name` is what a finding is called.
  void add(const std::string& name, const std::string& word);
  size_t size() const { return forms_.size(); }

  /// Names of the words in it.
  std::vector<std::string> found_in(const std::string& bytes) const;
  /// "relative/path: name" of every word in the files below a folder, or in their names.
  std::vector<std::string> found_below(const std::filesystem::path& folder) const;

 private:
  std::map<std::string, std::vector<std::string>> forms_;
};

}  // namespace ream::test
