#include "fe/ordered_output.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "core/error.hpp"
#include "core/thread_pool.hpp"

namespace ream::fe {
namespace {

/// Where each piece begins, known once all before it have been made.
class Places {
 public:
  explicit Places(uint64_t begin) : next_begin_(begin) {}

  uint64_t of(size_t i, size_t bytes) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return next_ == i || given_up_; });
    if (given_up_) throw Error(ErrorKind::cancelled, "given up with the rest of the file");
    const uint64_t begin = next_begin_;
    next_begin_ += bytes;
    ++next_;
    changed_.notify_all();
    return begin;
  }
  void give_up() {
    const std::lock_guard lock(mutex_);
    given_up_ = true;
    changed_.notify_all();
  }
  uint64_t end() const { return next_begin_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  size_t next_ = 0;
  uint64_t next_begin_;
  bool given_up_ = false;
};

/// Buffers that are used again, so that their pages are touched for the first time once.
class Buffers {
 public:
  struct Buffer {
    std::unique_ptr<char[]> bytes;
    size_t size = 0;
  };
  Buffer take(size_t size) {
    Buffer buffer;
    {
      const std::lock_guard lock(mutex_);
      if (!free_.empty()) {
        buffer = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (buffer.size < size) buffer = {std::unique_ptr<char[]>(new char[size]), size};
    return buffer;
  }
  void give_back(Buffer buffer) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(buffer));
  }

 private:
  std::mutex mutex_;
  std::vector<Buffer> free_;
};

}  // namespace

void OrderedOutput::append(std::string_view text) {
  file_.write_at(bytes_, std::as_bytes(std::span(text)));
  bytes_ += text.size();
}

void OrderedOutput::append(const Pieces& pieces, const Progress& progress, std::string_view step) {
  Places places(bytes_);
  Buffers buffers;
  const auto work = [&](size_t i) {
    Buffers::Buffer buffer;
    size_t size = 0;
    try {
      buffer = buffers.take(pieces.max_bytes(i));
      size = static_cast<size_t>(pieces.make(i, buffer.bytes.get()) - buffer.bytes.get());
    } catch (...) {
      places.give_up();
      throw;
    }
    const uint64_t begin = places.of(i, size);
    file_.write_at(begin, std::as_bytes(std::span(buffer.bytes.get(), size)));
    buffers.give_back(std::move(buffer));
  };
  parallel_for(2, pieces.count, work, progress, step);
  bytes_ = places.end();
}

}  // namespace ream::fe
