#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/pose.hpp"

namespace ream::record::ops {

using Bytes = std::vector<std::byte>;

/// Appends a field as proto/recording.json describes its type. Texts and bytes are below 4 GiB.
void put_field(Bytes& out, uint8_t value);
void put_field(Bytes& out, uint32_t value);
void put_field(Bytes& out, uint64_t value);
void put_field(Bytes& out, int32_t value);
void put_field(Bytes& out, float value);
void put_field(Bytes& out, double value);
void put_field(Bytes& out, const std::string& value);
void put_field(Bytes& out, const Bytes& value);
void put_field(Bytes& out, const QuantisedPose& value);

/// Takes fields off the front of bytes; what does not fit stays as it is and is remembered. Never reads
/// beyond the bytes.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  void take(uint8_t& value);
  void take(uint32_t& value);
  void take(uint64_t& value);
  void take(int32_t& value);
  void take(float& value);
  void take(double& value);
  void take(std::string& value);
  void take(Bytes& value);
  void take(QuantisedPose& value);
  /// The next `count` bytes; empty when there are not that many.
  std::span<const std::byte> take_bytes(size_t count);

  bool fits() const { return fits_; }  ///< nothing has been asked for that was not there
  std::span<const std::byte> rest() const { return rest_; }

 private:
  std::span<const std::byte> rest_;
  bool fits_ = true;
};

/// How many 32-bit words a field takes in columns, and the words themselves: low half first.
template <typename Field>
inline constexpr uint32_t words_of = sizeof(Field) / 4;
static_assert(sizeof(QuantisedPose) == 12 * 4);

inline void put_words(uint32_t*& out, uint32_t value) { *out++ = value; }
inline void put_words(uint32_t*& out, int32_t value) { *out++ = static_cast<uint32_t>(value); }
inline void put_words(uint32_t*& out, float value) { *out++ = std::bit_cast<uint32_t>(value); }
inline void put_words(uint32_t*& out, uint64_t value) {
  *out++ = static_cast<uint32_t>(value);
  *out++ = static_cast<uint32_t>(value >> 32);
}
inline void put_words(uint32_t*& out, double value) { put_words(out, std::bit_cast<uint64_t>(value)); }
inline void put_words(uint32_t*& out, const QuantisedPose& value) {
  for (const int32_t q : value.rotation_q30) put_words(out, q);
  for (const int32_t q : value.translation_nm) put_words(out, q);
}

inline void take_words(const uint32_t*& in, uint32_t& value) { value = *in++; }
inline void take_words(const uint32_t*& in, int32_t& value) { value = static_cast<int32_t>(*in++); }
inline void take_words(const uint32_t*& in, float& value) { value = std::bit_cast<float>(*in++); }
inline void take_words(const uint32_t*& in, uint64_t& value) {
  const uint64_t low = *in++;
  value = low | static_cast<uint64_t>(*in++) << 32;
}
inline void take_words(const uint32_t*& in, double& value) {
  uint64_t bits = 0;
  take_words(in, bits);
  value = std::bit_cast<double>(bits);
}
inline void take_words(const uint32_t*& in, QuantisedPose& value) {
  for (int32_t& q : value.rotation_q30) take_words(in, q);
  for (int32_t& q : value.translation_nm) take_words(in, q);
}

}  // namespace ream::record::ops
