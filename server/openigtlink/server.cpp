#include "openigtlink/server.hpp"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/signal_handlers.hpp"

namespace ream::openigtlink {
namespace {

/// With clients, the stream is looked at this often, ms; without, nothing is done until one comes.
constexpr int poll_interval_ms = 10;
/// Making and packing a surface takes no larger share of this thread's time than one in so many.
constexpr int64_t surface_share = 10;
constexpr std::chrono::milliseconds after_failure{1000};

int64_t unix_ns_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// When something happened that the steady clock knows of.
int64_t unix_ns_at(int64_t steady_us) { return unix_ns_now() - (steady_ns() - steady_us * 1000); }

}  // namespace

Server::Server(ServerOptions options, std::shared_ptr<const ActiveSession> active_session)
    : options_(std::move(options)),
      active_session_(std::move(active_session)),
      socket_(options_.host, options_.port),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!wake_) throw Error(ErrorKind::unavailable, "OpenIGTLink: too many files are open in this program");
  thread_ = start_thread([this] { run(); });
}

Server::~Server() {
  stopping_.store(true, std::memory_order_release);
  static_cast<void>(::eventfd_write(wake_.get(), 1));
  thread_.join();
}

/// Whatever goes wrong costs the clients their connection, and nobody else anything.
void Server::run() noexcept {
  while (!stopping_.load(std::memory_order_acquire)) {
    try {
      wait_for_events();
      poll_once();
    } catch (...) {
      log::current_exception("OpenIGTLink: its clients were disconnected");
      clients_.clear();
      unsubscribe();
      std::this_thread::sleep_for(after_failure);
    }
  }
}

void Server::wait_for_events() const {
  std::vector<pollfd> waited{{wake_.get(), POLLIN, 0}, {socket_.descriptor(), POLLIN, 0}};
  for (const ClientConnection& client : clients_)
    if (client.waits()) waited.push_back({client.descriptor(), POLLOUT, 0});
  ::poll(waited.data(), waited.size(), clients_.empty() ? -1 : poll_interval_ms);
}

void Server::poll_once() {
  accept_clients();
  if (clients_.empty()) return;
  follow_active_session();
  const int64_t now_ns = steady_ns();
  if (mailbox_) take(now_ns);
  std::erase_if(clients_, [&](ClientConnection& client) { return !client.serve(cache_, now_ns); });
  if (clients_.empty()) unsubscribe();
}

void Server::accept_clients() {
  while (FileDescriptor client = socket_.accept())
    if (clients_.size() < options_.max_clients) clients_.emplace_back(std::move(client), steady_ns());
  // Somebody waits who cannot be let in, for want of descriptors or memory: not to be asked for without end.
  if (errno != EAGAIN && errno != EWOULDBLOCK)
    std::this_thread::sleep_for(std::chrono::milliseconds(poll_interval_ms));
}

void Server::unsubscribe() {
  mailbox_.reset();
  picture_.reset();
  session_.reset();
  cache_.clear();
}

void Server::follow_active_session() {
  const std::shared_ptr<const SessionView> now = active_session_->get();
  if (!now && !cache_.message(static_cast<size_t>(Topic::status)).message)
    put_no_session(unix_ns_now(), cache_);
  if (now == session_) return;
  unsubscribe();
  session_ = now;
  put_session(*now, unix_ns_now(), cache_);
  sent_ = {};
  bone_due_ns_ = 0;
  bone_changed_ = false;
  picture_.emplace(now->grid);
  // A session that is gone meanwhile says nothing more.
  if (const auto fanout = now->fanout.lock()) mailbox_ = fanout->subscribe([] {}, 1);
}

void Server::take(int64_t now_ns) {
  stream::Parcel parcel = mailbox_->take();
  // A surface is whole once all blocks of an update have come.
  const bool quiet = parcel.blocks.empty();
  for (stream::SharedBlock& block : parcel.blocks) picture_->take(std::move(block));
  bone_changed_ |= !quiet;
  if (parcel.newest)
    put_tick(parcel.newest->samples.back(), unix_ns_at(parcel.newest->stamp_us), sent_, cache_);
  if (bone_changed_ && quiet && parcel.picture_complete && now_ns >= bone_due_ns_) put_bone(now_ns);
}

void Server::put_bone(int64_t now_ns) {
  bone_changed_ = false;
  cache_.put(Topic::bone, polydata_message({"Bone", unix_ns_now()}, picture_->in_ras()));
  const int64_t took_ns = steady_ns() - now_ns;
  bone_due_ns_ = steady_ns() + std::max(options_.bone_interval_ns, surface_share * took_ns);
}

}  // namespace ream::openigtlink
