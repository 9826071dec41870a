#include "twin/part_file.hpp"

#include <zlib.h>

#include <new>

namespace ream::twin {
namespace {

constexpr int gzip_window_bits = 15 + 16, memory_level = 9;
constexpr size_t output_step = 1 << 16;

}  // namespace

struct PartFileWriter::Stream {
  z_stream z{};
};

PartFileWriter::PartFileWriter(const FileMagic& magic, uint32_t revision)
    : stream_(std::make_unique<Stream>()) {
  if (::deflateInit2(&stream_->z, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window_bits, memory_level,
                     Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  Bytes head;
  for (const char c : magic) head.push_back(static_cast<std::byte>(c));
  record::ops::put_field(head, revision);
  put(head, false);
}

PartFileWriter::~PartFileWriter() { ::deflateEnd(&stream_->z); }

void PartFileWriter::add(std::span<const std::byte> part) {
  Bytes length;
  record::ops::put_field(length, static_cast<uint32_t>(part.size()));
  put(length, false);
  put(part, false);
}

Bytes PartFileWriter::finish() {
  put({}, true);
  return std::move(out_);
}

void PartFileWriter::put(std::span<const std::byte> raw, bool last) {
  z_stream& z = stream_->z;
  z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(raw.data()));
  z.avail_in = static_cast<uInt>(raw.size());
  do {
    const size_t before = out_.size();
    out_.resize(before + output_step);
    z.next_out = reinterpret_cast<Bytef*>(out_.data() + before);
    z.avail_out = output_step;
    ::deflate(&z, last ? Z_FINISH : Z_NO_FLUSH);
    out_.resize(out_.size() - z.avail_out);
  } while (z.avail_out == 0);
}

}  // namespace ream::twin
