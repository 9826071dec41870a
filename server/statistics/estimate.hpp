#pragma once
#include <optional>
#include <string>

namespace ream::statistics {

/// A confidence interval; its level is the caller's.
struct Interval {
  double low = 0.0, high = 0.0;
};

/// What a sample says, or a sentence that tells why it says nothing. Beside a value, `note` tells why a part
/// of it is missing. The sentence begins with a small letter and goes on from the name of the thing.
template <typename T>
struct Answer {
  std::optional<T> value;
  std::string note;

  explicit operator bool() const { return value.has_value(); }
  const T& operator*() const { return *value; }
  const T* operator->() const { return &*value; }
};

}  // namespace ream::statistics
