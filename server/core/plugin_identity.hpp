#pragma once
#include <string>

namespace ream {

/// A plug-in as recordings and scores name it.
struct PluginIdentity {
  std::string name, version;  ///< as it says
  std::string sha256;         ///< of its file: 64 hexadecimal digits, lower case

  /// "plug-in softbone 1.2 (sha256 0123456789abcdef)"
  std::string in_words() const {
    return "plug-in " + name + " " + version + " (sha256 " + sha256.substr(0, 16) + ")";
  }
  bool operator==(const PluginIdentity&) const = default;
};

}  // namespace ream
