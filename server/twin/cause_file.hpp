#pragma once
#include <memory>
#include <span>

#include "twin/cause_parts.hpp"

namespace ream::twin {

inline constexpr char cause_file_magic[8] = {'r', 'e', 'a', 'm', 't', 'w', 'i', 'n'};
inline constexpr uint32_t cause_file_revision = 1;

/// Makes a file of parts that a browser unpacks by itself: one gzip stream of cause_file_magic, u32
/// cause_file_revision, then each part after its u32 length.
class CauseFileWriter {
 public:
  CauseFileWriter();
  ~CauseFileWriter();
  void add(const Bytes& part);
  /// The whole file; nothing is added after that.
  Bytes finish();

 private:
  struct Stream;
  void put(std::span<const std::byte> raw, bool last);

  std::unique_ptr<Stream> stream_;
  Bytes out_;
};

}  // namespace ream::twin
