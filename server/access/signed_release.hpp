#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ream::access {

/// A folder that was released: its files, SHA256SUMS that names them all, and SHA256SUMS.minisig, by which
/// somebody's key of minisign (Ed25519) signed that list.
struct SignedRelease {
  std::string key, comment;  ///< the key's name, as minisign prints it; what was said, and signed, too
  std::vector<std::string> files;
};

/// `key`: minisign's public key, or a file whose last line it is. Errors: not_found for what is missing or
/// cannot be read; invalid_input where the key is none, the list is not what was signed, or a file is not
/// what the list says, or is not in it.
SignedRelease verify_release(const std::filesystem::path& folder, const std::string& key);

/// 64 hexadecimal digits, lower case. Errors: not_found; io.
std::string sha256_of(const std::filesystem::path& file);

}  // namespace ream::access
