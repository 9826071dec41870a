#include "net/reply_writer.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/post.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/log.hpp"
#include "net/file_body.hpp"

namespace ream::net {
namespace asio = boost::asio;
using boost::system::error_code;

void ReplyWriter::send(Order order) {
  order_ = std::move(order);
  leaving_ = {asio::buffer(order_.head), order_.body ? asio::buffer(*order_.body) : asio::const_buffer()};
  const Limits& limits = engine_.limits;
  pace_ = TransferPace(TransferPace::Clock::now(), limits.write, limits.write, limits.least_bytes_per_s);
  write_some();
}

void ReplyWriter::write_some() {
  if (asio::buffer_size(leaving_) == 0) {
    if (order_.file && order_.file->bytes > 0)
      fetch_piece();
    else
      finish();
    return;
  }
  const auto owner = order_.owner.lock();
  watchdog_.arm(pace_.patience(TransferPace::Clock::now()), owner);
  channel_.async_write_some(leaving_, [this, owner](error_code failed, size_t written) {
    if (failed) {
      watchdog_.close();
      return;
    }
    pace_.moved(written);
    for (asio::const_buffer& buffer : leaving_) {
      const size_t of_this = std::min(written, buffer.size());
      buffer += of_this;
      written -= of_this;
    }
    write_some();
  });
}

/// The disk may take its time: a thread of its own waits for it.
void ReplyWriter::fetch_piece() {
  watchdog_.disarm();
  const bool taken = engine_.file_readers.submit([this, owner = order_.owner.lock()] {
    const bool whole = read_piece();
    asio::post(channel_.get_executor(), [this, owner, whole] {
      leaving_ = {asio::buffer(piece_), asio::const_buffer()};
      if (whole)
        write_some();
      else
        watchdog_.close();
    });
  });
  if (!taken) watchdog_.close();
}

/// False when the file is not what it was: what was promised cannot be sent any more.
bool ReplyWriter::read_piece() {
  FileStretch& stretch = *order_.file;
  piece_.resize(std::min<uint64_t>(stretch.bytes, engine_.limits.file_piece_bytes));
  try {
    if (stretch.file->read(stretch.offset, piece_) < piece_.size())
      throw Error(ErrorKind::io, "a file became shorter while it was sent");
  } catch (const Error& failure) {
    log::error(failure.what());
    return false;
  }
  stretch.offset += piece_.size();
  stretch.bytes -= piece_.size();
  return true;
}

void ReplyWriter::finish() {
  watchdog_.disarm();
  piece_ = {};
  const auto done = std::exchange(order_, {}).done;
  done();
}

}  // namespace ream::net
