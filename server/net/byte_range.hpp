#pragma once
#include <cstdint>
#include <string_view>

namespace ream::net {

/// What a Range header asks of a body.
struct ByteRange {
  enum class Answer {
    whole,          ///< there is no range that is understood: all of it (200)
    part,           ///< `bytes` from `offset` (206)
    unsatisfiable,  ///< nothing of it exists (416)
  };
  Answer answer = Answer::whole;
  uint64_t offset = 0, bytes = 0;
};

/// Reads "bytes=0-99", "bytes=100-" or "bytes=-100" (RFC 9110, 14.1.2) for a body of `size` bytes. Other
/// units, several ranges and what is not understood ask for the whole.
ByteRange read_range(std::string_view header, uint64_t size);

}  // namespace ream::net
