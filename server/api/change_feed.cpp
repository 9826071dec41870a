#include "api/change_feed.hpp"

#include <nlohmann/json.hpp>

#include "access/role.hpp"
#include "api/visibility.hpp"
#include "core/new_id.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

/// Of a fresh server: above all that an earlier one has given, below what JavaScript counts exactly.
uint64_t first_number() {
  return static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(
                                   std::chrono::system_clock::now().time_since_epoch())
                                   .count());
}

net::SharedBytes text_of(const json& message) {
  return net::share(message.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

bool may_know(const net::Caller& caller, const Change& change) {
  const access::Roles role = access::role_bit(caller.role);
  if (change.session) return may_see(caller, *change.session);
  if (change.kind == "case") return (role & access::reamers) != 0;
  if (change.kind == "user") return role == access::operators;
  return (role & access::staff) != 0;
}

/// One connection. Its cursor is where it stands in what all share.
class ChangeFeed::Listener final : public net::WebSocketSession {
 public:
  Listener(std::shared_ptr<ChangeFeed> feed, net::Caller caller, std::optional<uint64_t> since)
      : feed_(std::move(feed)), caller_(std::move(caller)), since_(since) {}

  bool sends_text() const override { return true; }

  void on_open(std::function<void()> wake) override {
    const std::lock_guard lock(feed_->mutex_);
    feed_->wakers_.push_back({this, std::move(wake)});
  }

  std::optional<net::SharedBytes> next() override {
    if (!greeted_) return greeting();
    Next next = feed_->next_after(number_, caller_);
    if (next.missed) return text_of({{"kind", "missed"}, {"number", number_}});
    if (!next.message) return std::nullopt;
    return std::move(next.message);
  }

  void on_message(std::span<const std::byte>) override {}

  void on_close() noexcept override {
    const std::lock_guard lock(feed_->mutex_);
    std::erase_if(feed_->wakers_, [this](const Waker& waker) { return waker.of == this; });
  }

 private:
  net::SharedBytes greeting() {
    greeted_ = true;
    const std::lock_guard lock(feed_->mutex_);
    number_ = feed_->newest_;
    const uint64_t kept = feed_->kept_.empty() ? feed_->newest_ : feed_->kept_.front().number - 1;
    const bool missed = since_ && (*since_ < kept || *since_ > number_);
    const json hello = {{"kind", "hello"}, {"number", number_}, {"missed", missed}};
    if (since_ && !missed) number_ = *since_;
    return text_of(hello);
  }

  const std::shared_ptr<ChangeFeed> feed_;
  const net::Caller caller_;
  const std::optional<uint64_t> since_;
  bool greeted_ = false;
  uint64_t number_ = 0;
};

ChangeFeed::ChangeFeed(size_t max_kept) : max_kept_(max_kept), newest_(first_number()) {}

void ChangeFeed::publish(const Change& change) {
  std::vector<std::function<void()>> wakes;
  {
    const std::lock_guard lock(mutex_);
    ++newest_;
    kept_.push_back({newest_, change,
                     text_of({{"kind", change.kind},
                              {"number", newest_},
                              {"utc", utc_now()},
                              {"id", change.id},
                              {"change", change.change}})});
    if (kept_.size() > max_kept_) kept_.pop_front();
    for (const Waker& waker : wakers_) wakes.push_back(waker.wake);
  }
  for (const auto& wake : wakes) wake();
}

ChangeFeed::Next ChangeFeed::next_after(uint64_t& number, const net::Caller& caller) const {
  const std::lock_guard lock(mutex_);
  if (number >= newest_) return {};
  if (kept_.empty() || number + 1 < kept_.front().number) {
    number = newest_;
    return {nullptr, true};
  }
  auto next = kept_.begin() + static_cast<std::ptrdiff_t>(number + 1 - kept_.front().number);
  for (; next != kept_.end(); ++next) {
    number = next->number;
    if (may_know(caller, next->change)) return {next->message, false};
  }
  return {};
}

std::unique_ptr<net::WebSocketSession> ChangeFeed::listen(const net::Caller& caller,
                                                          std::optional<uint64_t> since) {
  return std::make_unique<Listener>(shared_from_this(), caller, since);
}

}  // namespace ream::api
