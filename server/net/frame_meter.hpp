#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace ream::net {

/// Counts the frames of a WebSocket (RFC 6455, 5.2) in the bytes that come from its peer, wherever they are
/// cut. It sees those too that a library swallows without a word, as empty fragments and pongs. What is no
/// frame at all is for the library to refuse.
class FrameMeter {
 public:
  /// How many frames begin in `bytes`, which follow those of the last call.
  size_t count(std::span<const std::byte> bytes);

 private:
  size_t header_bytes_known() const;
  uint64_t payload_bytes() const;

  std::array<std::byte, 14> header_{};
  size_t have_ = 0;            ///< of the header
  uint64_t payload_left_ = 0;  ///< of the frame before the next header
};

}  // namespace ream::net
