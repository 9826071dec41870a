#include "access/password_hasher.hpp"

#include <sodium.h>
#include <future>

#include "access/login_backoff.hpp"
#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/signal_handlers.hpp"

namespace ream::access {

PasswordHasher::PasswordHasher(size_t max_pending, HashCost cost) : max_pending_(max_pending), cost_(cost) {
  require_sodium();
  thread_ = start_thread([this] { work(); });
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

}  // namespace ream::access
