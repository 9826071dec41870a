#include "access/signed_release.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace ream::access {
namespace {

namespace fs = std::filesystem;

constexpr const char* sums_name = "SHA256SUMS";
constexpr const char* signature_name = "SHA256SUMS.minisig";
/// Of a list, a signature or a key: hundreds of files.
constexpr size_t max_text_bytes = 1 << 16;

[[noreturn]] void refuse_release(const std::string& why) {
  throw Error(ErrorKind::invalid_input, why + "; do not install it");
}

std::ifstream opened(const fs::path& file) {
  std::error_code failed;
  std::ifstream stream;
  if (fs::is_regular_file(fs::symlink_status(file, failed))) stream.open(file, std::ios::binary);
  if (!stream.is_open())
    throw Error(ErrorKind::not_found, file.string() + " is not there, or cannot be read");
  return stream;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream = opened(file);
  std::string text(max_text_bytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(stream.gcount()));
  if (text.size() > max_text_bytes)
    throw Error(ErrorKind::invalid_input, file.string() + " is larger than 64 kB: it is of no release");
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

template <size_t size>
using Bytes = std::array<unsigned char, size>;

/// A line of base64 that holds exactly so many bytes.
template <size_t size>
bool decode(const std::string& line, Bytes<size>& bytes) {
  size_t found = 0;
  return sodium_base642bin(bytes.data(), size, line.data(), line.size(), nullptr, &found, nullptr,
                           sodium_base64_VARIANT_ORIGINAL) == 0 &&
         found == size;
}

/// minisign's form of an Ed25519 key: "Ed", eight bytes that name it, the key.
struct PublicKey {
  Bytes<42> bytes{};
  const unsigned char* key() const { return bytes.data() + 10; }
};

/// As minisign prints it: the eight bytes from the last to the first.
std::string name_of_key(const unsigned char* id) {
  std::string turned(reinterpret_cast<const char*>(id), 8);
  std::reverse(turned.begin(), turned.end());
  std::string name = hex_of(turned);
  for (char& digit : name)
    if (digit >= 'a') digit = static_cast<char>(digit - 'a' + 'A');
  return name;
}

/// `key`: the key itself, or a file whose last line it is.
PublicKey public_key_of(const std::string& key) {
  PublicKey found;
  if (decode(key, found.bytes) && found.bytes[0] == 'E' && found.bytes[1] == 'd') return found;
  const std::vector<std::string> lines = lines_of(text_of(key));
  if (lines.empty() || !decode(lines.back(), found.bytes) || found.bytes[0] != 'E' || found.bytes[1] != 'd')
    throw Error(ErrorKind::invalid_input, key + " holds no public key of minisign");
  return found;
}

/// minisign's two signatures: of the text's BLAKE2b, and of that signature with its comment.
SignedRelease verify_signature(const fs::path& folder, const std::string& text, const PublicKey& key) {
  const fs::path file = folder / signature_name;
  const std::vector<std::string> lines = lines_of(text_of(file));
  constexpr std::string_view comment_mark = "trusted comment: ";
  Bytes<74> signature{};
  Bytes<64> whole{};
  if (lines.size() != 4 || !decode(lines[1], signature) || !lines[2].starts_with(comment_mark) ||
      !decode(lines[3], whole) || signature[0] != 'E' || signature[1] != 'D')
    refuse_release(file.string() + " is no signature of minisign");
  const std::string signer = name_of_key(signature.data() + 2), wanted = name_of_key(key.bytes.data() + 2);
  if (signer != wanted)
    refuse_release("the release is signed with the key " + signer + ", not with " + wanted);

  Bytes<64> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), nullptr, 0);
  const std::string comment = lines[2].substr(comment_mark.size());
  std::string said(reinterpret_cast<const char*>(signature.data()) + 10, 64);
  said += comment;
  if (crypto_sign_verify_detached(signature.data() + 10, hash.data(), hash.size(), key.key()) != 0 ||
      crypto_sign_verify_detached(whole.data(), reinterpret_cast<const unsigned char*>(said.data()),
                                  said.size(), key.key()) != 0)
    refuse_release((folder / sums_name).string() + " is not what was signed");
  return {signer, comment, {}};
}

/// "<hash>  <name>" a line, as sha256sum writes it; names lie in the folder itself.
void verify_files(const fs::path& folder, const std::string& sums, std::vector<std::string>& names) {
  constexpr size_t digits = 2 * size_t{crypto_hash_sha256_BYTES};
  for (const std::string& line : lines_of(sums)) {
    const std::string name = line.size() > digits + 2 ? line.substr(digits + 2) : "";
    if (name.empty() || line[digits] != ' ' || name.find('/') != std::string::npos || name == "." ||
        name == "..")
      refuse_release((folder / sums_name).string() +
                     " has a line that is none of sha256sum: " + one_line(line, 100));
    if (sha256_of(folder / name) != line.substr(0, digits))
      refuse_release((folder / name).string() + " was changed");
    names.push_back(name);
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name != sums_name && name != signature_name &&
        std::find(names.begin(), names.end(), name) == names.end())
      refuse_release((folder / one_line(name, 100)).string() + " is not of the release");
  }
}

}  // namespace

std::string sha256_of(const fs::path& file) {
  std::ifstream stream = opened(file);
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  std::vector<char> part(1 << 20);
  while (stream.read(part.data(), static_cast<std::streamsize>(part.size())) || stream.gcount() > 0)
    crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(part.data()),
                              static_cast<unsigned long long>(stream.gcount()));
  if (stream.bad()) throw Error(ErrorKind::io, "cannot read " + file.string());
  std::string hash(crypto_hash_sha256_BYTES, '\0');
  crypto_hash_sha256_final(&state, reinterpret_cast<unsigned char*>(hash.data()));
  return hex_of(hash);
}

SignedRelease verify_release(const fs::path& folder, const std::string& key) {
  require_sodium();
  const PublicKey wanted = public_key_of(key);
  const std::string sums = text_of(folder / sums_name);
  SignedRelease release = verify_signature(folder, sums, wanted);
  verify_files(folder, sums, release.files);
  if (release.files.empty()) refuse_release((folder / sums_name).string() + " names no file");
  return release;
}

}  // namespace ream::access
