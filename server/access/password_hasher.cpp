#include "access/password_hasher.hpp"

#include <sodium.h>
#include <algorithm>
#include <future>
#include <optional>

#include "access/login_backoff.hpp"
#include "access/secret.hpp"
#include "core/error.hpp"

namespace ream::access {
namespace {

size_t bytes_of_character(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// None when it is not UTF-8.
std::optional<size_t> characters_of(const std::string& text) {
  size_t count = 0;
  for (size_t at = 0; at < text.size(); ++count) {
    const size_t bytes = bytes_of_character(static_cast<unsigned char>(text[at]));
    if (bytes == 0 || at + bytes > text.size()) return std::nullopt;
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
    if (!std::all_of(begin + 1, begin + static_cast<std::ptrdiff_t>(bytes),
                     [](unsigned char byte) { return (byte & 0xc0) == 0x80; }))
      return std::nullopt;
    at += bytes;
  }
  return count;
}

}  // namespace

PasswordHasher::PasswordHasher(size_t max_pending, HashCost cost) : max_pending_(max_pending), cost_(cost) {
  require_sodium();
  thread_ = std::thread([this] { work(); });
}

PasswordHasher::~PasswordHasher() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PasswordHasher::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopped_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const std::function<void()> task = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    task();
  }
}

void PasswordHasher::run_on_thread(const std::function<void()>& task) {
  auto packaged = std::make_shared<std::packaged_task<void()>>(task);
  std::future<void> done = packaged->get_future();
  {
    const std::lock_guard lock(mutex_);
    if (pending_ >= max_pending_)
      throw TooManyAttempts("too many logins at this moment; try again in a second", 1);
    ++pending_;
    waiting_.push_back([packaged] { (*packaged)(); });
  }
  changed_.notify_all();
  done.wait();
  {
    const std::lock_guard lock(mutex_);
    --pending_;
  }
  done.get();
}

std::string PasswordHasher::hashed(const Secret& password) const {
  std::string text(crypto_pwhash_STRBYTES, '\0');
  if (crypto_pwhash_str_alg(text.data(), password.reveal().data(), password.reveal().size(), cost_.operations,
                            cost_.memory_bytes, crypto_pwhash_ALG_ARGON2ID13) != 0)
    throw Error(ErrorKind::unavailable, "not enough memory to hash a password; try again");
  text.resize(text.find('\0'));
  return text;
}

std::string PasswordHasher::hash(const Secret& password) {
  std::string text;
  run_on_thread([&] { text = hashed(password); });
  return text;
}

PasswordHasher::Verdict PasswordHasher::verify(const Secret& password, const std::string& hash) {
  Verdict verdict;
  run_on_thread([&] {
    if (dummy_hash_.empty()) dummy_hash_ = hashed(Secret(std::string_view("nobody's password")));
    const std::string& against = hash.empty() ? dummy_hash_ : hash;
    const bool equal =
        crypto_pwhash_str_verify(against.c_str(), password.reveal().data(), password.reveal().size()) == 0;
    verdict.right = equal && !hash.empty();
    verdict.outdated = verdict.right && crypto_pwhash_str_needs_rehash(hash.c_str(), cost_.operations,
                                                                       cost_.memory_bytes) != 0;
  });
  return verdict;
}

void require_good_password(const Secret& password) {
  if (password.reveal().size() > max_password_bytes)
    throw Error(ErrorKind::invalid_input,
                "a password has at most " + std::to_string(max_password_bytes) + " bytes");
  const auto characters = characters_of(password.reveal());
  if (!characters) throw Error(ErrorKind::invalid_input, "a password must be UTF-8 text");
  if (*characters < min_password_length)
    throw Error(ErrorKind::invalid_input,
                "a password has at least " + std::to_string(min_password_length) + " characters");
}

}  // namespace ream::access
