#include "openigtlink/client_line.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace ream::openigtlink {
namespace {

/// Of what a client says, looked at in one round.
constexpr int most_reads = 16;
/// Between two calls that come one after the other.
constexpr int64_t longest_round_ns = 1'000'000'000;

bool would_wait() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

bool ClientLine::hear() {
  std::array<std::byte, 4096> heard;
  for (int i = 0; i < most_reads; ++i) {
    const ssize_t count = ::recv(socket_.get(), heard.data(), heard.size(), 0);
    if (count == 0) return false;
    if (count < 0) return would_wait();
  }
  return true;
}

bool ClientLine::choose(const Board& board) {
  for (size_t i = 0; i < topic_count; ++i) {
    const size_t topic = (turn_ + i) % topic_count;
    const Board::Sheet& sheet = board.sheet(topic);
    if (!sheet.message || sheet.edition == has_[topic]) continue;
    has_[topic] = sheet.edition;
    writing_ = sheet.message;
    written_ = 0;
    turn_ = topic + 1;
    return true;
  }
  return false;
}

bool ClientLine::serve(const Board& board, int64_t now_ns) {
  waited_ns_ += std::min(now_ns - served_ns_, longest_round_ns);
  served_ns_ = now_ns;
  if (!hear()) return false;
  while (writing_ || choose(board)) {
    const ssize_t count =
        ::send(socket_.get(), writing_->data() + written_, writing_->size() - written_, MSG_NOSIGNAL);
    if (count < 0) return would_wait() && waited_ns_ < patience_ns;
    waited_ns_ = 0;
    written_ += static_cast<size_t>(count);
    if (written_ == writing_->size()) writing_.reset();
  }
  waited_ns_ = 0;
  return true;
}

}  // namespace ream::openigtlink
