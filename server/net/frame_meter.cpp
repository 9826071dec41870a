#include "net/frame_meter.hpp"

#include <algorithm>

namespace ream::net {
namespace {

constexpr unsigned mask_bit = 0x80, length_bits = 0x7f, two_bytes_follow = 126, eight_bytes_follow = 127;
constexpr size_t min_header_bytes = 2, mask_bytes = 4;

}  // namespace

size_t FrameMeter::count(std::span<const std::byte> bytes) {
  size_t frames = 0;
  while (!bytes.empty()) {
    if (payload_left_ > 0) {
      const auto skipped = static_cast<size_t>(std::min<uint64_t>(payload_left_, bytes.size()));
      payload_left_ -= skipped;
      bytes = bytes.subspan(skipped);
      continue;
    }
    if (have_ == 0) ++frames;
    header_[have_++] = bytes.front();
    bytes = bytes.subspan(1);
    if (have_ == header_bytes_known()) {
      payload_left_ = payload_bytes();
      have_ = 0;
    }
  }
  return frames;
}

/// As far as the bytes at hand tell.
size_t FrameMeter::header_bytes_known() const {
  if (have_ < min_header_bytes) return min_header_bytes;
  const auto second = std::to_integer<unsigned>(header_[1]);
  const unsigned length = second & length_bits;
  return min_header_bytes +
         (length == two_bytes_follow     ? 2
          : length == eight_bytes_follow ? 8
                                         : 0) +
         ((second & mask_bit) != 0 ? mask_bytes : 0);
}

uint64_t FrameMeter::payload_bytes() const {
  const unsigned length = std::to_integer<unsigned>(header_[1]) & length_bits;
  if (length < two_bytes_follow) return length;
  uint64_t bytes = 0;
  for (size_t i = 0; i < (length == two_bytes_follow ? 2u : 8u); ++i)
    bytes = bytes << 8 | std::to_integer<uint64_t>(header_[min_header_bytes + i]);
  return bytes;
}

}  // namespace ream::net
