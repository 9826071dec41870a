#pragma once
#include <string>
#include <string_view>

namespace ream::access {

/// Text that nobody else may see: a password, a token. It cannot be printed or turned into JSON by accident,
/// and its memory is wiped when it goes.
class Secret {
 public:
  Secret() = default;
  /// Takes the text over and wipes what it came in.
  explicit Secret(std::string&& text) noexcept;
  explicit Secret(std::string_view text) : text_(text) {}
  Secret(const Secret&) = default;
  Secret(Secret&& other) noexcept : Secret(std::move(other.text_)) {}
  Secret& operator=(const Secret& other);
  Secret& operator=(Secret&& other) noexcept;
  ~Secret();

  /// For hashing, comparing and handing it to its owner; never for a log, an error or a file.
  const std::string& reveal() const { return text_; }
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

/// Overwrites all that the string has held, and empties it.
void wipe(std::string& text) noexcept;

/// Takes as long whatever the texts hold, if they are equally long.
bool equal_in_constant_time(std::string_view a, std::string_view b);

/// The secret of a token, a cookie session or a link: "ream_<id>_<32 random bytes as base64url>". The id
/// finds it in the database, which holds its hash only.
struct CredentialSecret {
  std::string id;
  Secret text;
  std::string hash;
};

CredentialSecret make_credential_secret();

/// The id inside; empty when the text is not of that form.
std::string id_inside(const Secret& secret);

/// BLAKE2b of 32 bytes as base64url. For random secrets only: passwords need PasswordHasher.
std::string hash_of(const Secret& secret);
/// In constant time.
bool has_hash(const Secret& secret, const std::string& hash);

/// BLAKE2b of 32 bytes as base64url, of text that is no secret.
std::string fingerprint_of(const std::string& text);

/// What a page must send back with every change it makes by its cookie: a hash of the cookie's secret that
/// does not tell it.
std::string csrf_token_of(const Secret& cookie);

/// 256 bits at random, as 64 hex digits.
std::string random_key();

/// 16 hex digits of BLAKE2b of `text` under a key of random_key(): who does not have the key learns nothing
/// of it from any number of them, and cannot tell which text one is of.
std::string keyed_digest(const std::string& key, const std::string& text);

/// Ten letters and digits at random, without those that are easily taken for one another.
std::string random_id();

/// Makes libsodium ready; every function of this room that needs it calls this first. Error unavailable when
/// it cannot be.
void require_sodium();

}  // namespace ream::access
