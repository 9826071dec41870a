#include "store/sql.hpp"

#include "core/error.hpp"

namespace ream::store {
namespace {

/// Length of the UTF-8 sequence that begins at `at`, of which the shortest form is demanded; 0 for none.
size_t sequence_length(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at), second = byte(at + 1);
  const auto follows = [&](size_t i) { return (byte(at + i) & 0xc0u) == 0x80u; };
  if (first < 0x80) return first == 0 ? 0 : 1;
  if (first >= 0xc2 && first < 0xe0) return follows(1) ? 2 : 0;
  if (first >= 0xe0 && first < 0xf0) {
    const bool shortest = first != 0xe0 || second >= 0xa0, no_surrogate = first != 0xed || second < 0xa0;
    return shortest && no_surrogate && follows(1) && follows(2) ? 3 : 0;
  }
  if (first >= 0xf0 && first < 0xf5) {
    const bool shortest = first != 0xf0 || second >= 0x90, in_range = first != 0xf4 || second < 0x90;
    return shortest && in_range && follows(1) && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

bool is_storable(const std::string& text) {
  for (size_t at = 0; at < text.size();) {
    const size_t length = sequence_length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

thread_local bool unstorable = false;

}  // namespace

const std::string& storable(const std::string& text) {
  static const std::string nothing;
  if (is_storable(text)) return text;
  unstorable = true;
  return nothing;
}

void refuse_unstorable() {
  if (unstorable)
    throw Error(ErrorKind::invalid_input, "a text is no UTF-8, or holds a NUL; the database cannot keep it");
}

void forget_unstorable() { unstorable = false; }

}  // namespace ream::store
