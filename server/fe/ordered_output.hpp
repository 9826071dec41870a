#pragma once
#include <functional>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/progress.hpp"

namespace ream::fe {

/// Text at the end of a file in progress, made piece by piece on two threads and written in order.
class OrderedOutput {
 public:
  explicit OrderedOutput(const AtomicFile& file) : file_(file) {}

  void append(std::string_view text);

  struct Pieces {
    size_t count = 0;
    std::function<size_t(size_t i)> max_bytes;      ///< of piece i
    std::function<char*(size_t i, char* at)> make;  ///< writes it from `at` on, returns its end
  };
  /// Errors: io; what the functions and the progress throw.
  void append(const Pieces& pieces, const Progress& progress, std::string_view step);

  uint64_t bytes() const { return bytes_; }

 private:
  const AtomicFile& file_;
  uint64_t bytes_ = 0;
};

}  // namespace ream::fe
