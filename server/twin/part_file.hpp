#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "twin/cause_parts.hpp"

namespace ream::twin {

using FileMagic = std::array<char, 8>;
inline constexpr FileMagic cause_file_magic{'r', 'e', 'a', 'm', 't', 'w', 'i', 'n'};
inline constexpr uint32_t cause_file_revision = 1;

/// Makes a file of parts that a browser unpacks by itself: one gzip stream of 8 bytes that say what it is, a
/// u32 revision, then each part after its u32 length.
class PartFileWriter {
 public:
  PartFileWriter(const FileMagic& magic, uint32_t revision);
  ~PartFileWriter();
  void add(std::span<const std::byte> part);
  /// The whole file; nothing is added after that.
  Bytes finish();

 private:
  struct Stream;
  void put(std::span<const std::byte> raw, bool last);

  std::unique_ptr<Stream> stream_;
  Bytes out_;
};

}  // namespace ream::twin
