#include "access/secret.hpp"

#include <sodium.h>
#include <array>
#include <string_view>
#include <utility>

#include "core/error.hpp"

namespace ream::access {
namespace {

constexpr std::string_view prefix = "ream_";
constexpr std::string_view id_letters = "23456789abcdefghjkmnpqrstuvwxyz";
constexpr size_t id_length = 10, random_bytes = 32, encoded_length = 43;
constexpr int base64_url = sodium_base64_VARIANT_URLSAFE_NO_PADDING;

std::string base64url(const unsigned char* bytes, size_t size) {
  std::string text(sodium_base64_ENCODED_LEN(size, base64_url), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes, size, base64_url);
  text.pop_back();  // the terminating zero
  return text;
}

std::string hex(const unsigned char* bytes, size_t size) {
  std::string text(2 * size + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes, size);
  text.pop_back();  // the terminating zero
  return text;
}

/// `purpose` parts hashes of one secret for different uses.
std::string digest(const std::string& text, std::string_view purpose) {
  require_sodium();
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash_state state;
  crypto_generichash_init(&state, nullptr, 0, hash.size());
  for (const std::string_view part : {purpose, std::string_view("\0", 1), std::string_view(text)})
    crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(part.data()), part.size());
  crypto_generichash_final(&state, hash.data(), hash.size());
  sodium_memzero(&state, sizeof state);
  return base64url(hash.data(), hash.size());
}

}  // namespace

void wipe(std::string& text) noexcept {
  text.resize(text.capacity());
  sodium_memzero(text.data(), text.size());
  text.clear();
}

Secret::Secret(std::string&& text) noexcept : text_(std::move(text)) { wipe(text); }

Secret& Secret::operator=(const Secret& other) {
  if (this != &other) *this = Secret(other);
  return *this;
}

Secret& Secret::operator=(Secret&& other) noexcept {
  if (this == &other) return *this;
  wipe(text_);
  text_ = std::move(other.text_);
  wipe(other.text_);
  return *this;
}

Secret::~Secret() { wipe(text_); }

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

void require_sodium() {
  static const bool ready = sodium_init() >= 0;
  if (!ready) throw Error(ErrorKind::unavailable, "libsodium cannot be used on this machine");
}

std::string random_key() {
  require_sodium();
  std::array<unsigned char, crypto_generichash_KEYBYTES> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  return hex(bytes.data(), bytes.size());
}

std::string keyed_digest(const std::string& key, const std::string& text) {
  require_sodium();
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), reinterpret_cast<const unsigned char*>(key.data()), key.size());
  return hex(hash.data(), sizeof(uint64_t));
}

std::string random_id() {
  require_sodium();
  std::string id;
  for (size_t i = 0; i < id_length; ++i)
    id += id_letters[randombytes_uniform(static_cast<uint32_t>(id_letters.size()))];
  return id;
}

CredentialSecret make_credential_secret() {
  require_sodium();
  std::array<unsigned char, random_bytes> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  CredentialSecret made;
  made.id = random_id();
  std::string encoded = base64url(bytes.data(), bytes.size());
  sodium_memzero(bytes.data(), bytes.size());
  made.text = Secret(std::string(prefix) + made.id + "_" + encoded);
  wipe(encoded);
  made.hash = hash_of(made.text);
  return made;
}

std::string id_inside(const Secret& secret) {
  const std::string_view text = secret.reveal();
  if (text.size() != prefix.size() + id_length + 1 + encoded_length || !text.starts_with(prefix)) return {};
  const std::string_view id = text.substr(prefix.size(), id_length);
  const bool plain =
      id.find_first_not_of(id_letters) == std::string_view::npos && text[prefix.size() + id_length] == '_';
  return plain ? std::string(id) : std::string();
}

std::string hash_of(const Secret& secret) { return digest(secret.reveal(), "credential"); }

bool has_hash(const Secret& secret, const std::string& hash) {
  return equal_in_constant_time(hash_of(secret), hash);
}

std::string fingerprint_of(const std::string& text) { return digest(text, "fingerprint"); }

std::string csrf_token_of(const Secret& cookie) { return digest(cookie.reveal(), "csrf"); }

}  // namespace ream::access
