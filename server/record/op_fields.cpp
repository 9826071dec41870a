#include "record/op_fields.hpp"

namespace ream::record::ops {
namespace {

template <typename Word>
void put_little_endian(Bytes& out, Word word) {
  for (size_t k = 0; k < sizeof word; ++k) out.push_back(static_cast<std::byte>(word >> (8 * k)));
}

}  // namespace

void put_field(Bytes& out, uint8_t value) { out.push_back(static_cast<std::byte>(value)); }
void put_field(Bytes& out, uint32_t value) { put_little_endian(out, value); }
void put_field(Bytes& out, uint64_t value) { put_little_endian(out, value); }
void put_field(Bytes& out, int32_t value) { put_little_endian(out, static_cast<uint32_t>(value)); }
void put_field(Bytes& out, float value) { put_little_endian(out, std::bit_cast<uint32_t>(value)); }
void put_field(Bytes& out, double value) { put_little_endian(out, std::bit_cast<uint64_t>(value)); }

void put_field(Bytes& out, const std::string& value) {
  put_field(out, static_cast<uint32_t>(value.size()));
  const auto bytes = std::as_bytes(std::span(value));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

void put_field(Bytes& out, const Bytes& value) {
  put_field(out, static_cast<uint32_t>(value.size()));
  out.insert(out.end(), value.begin(), value.end());
}

void put_field(Bytes& out, const QuantisedPose& value) {
  for (const int32_t q : value.rotation_q30) put_field(out, q);
  for (const int32_t q : value.translation_nm) put_field(out, q);
}

std::span<const std::byte> FieldReader::take_bytes(size_t count) {
  if (count > rest_.size()) {
    fits_ = false;
    rest_ = {};
    return {};
  }
  const auto taken = rest_.first(count);
  rest_ = rest_.subspan(count);
  return taken;
}

void FieldReader::take(uint8_t& value) {
  if (const auto bytes = take_bytes(1); !bytes.empty()) value = std::to_integer<uint8_t>(bytes[0]);
}

void FieldReader::take(uint32_t& value) {
  const auto bytes = take_bytes(4);
  if (bytes.empty()) return;
  value = 0;
  for (size_t k = 0; k < 4; ++k) value |= std::to_integer<uint32_t>(bytes[k]) << (8 * k);
}

void FieldReader::take(uint64_t& value) {
  uint32_t low = 0, high = 0;
  take(low);
  take(high);
  if (fits_) value = low | static_cast<uint64_t>(high) << 32;
}

void FieldReader::take(int32_t& value) {
  auto word = static_cast<uint32_t>(value);
  take(word);
  value = static_cast<int32_t>(word);
}

void FieldReader::take(float& value) {
  auto word = std::bit_cast<uint32_t>(value);
  take(word);
  value = std::bit_cast<float>(word);
}

void FieldReader::take(double& value) {
  auto word = std::bit_cast<uint64_t>(value);
  take(word);
  value = std::bit_cast<double>(word);
}

void FieldReader::take(std::string& value) {
  uint32_t count = 0;
  take(count);
  const auto bytes = take_bytes(count);
  value.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void FieldReader::take(Bytes& value) {
  uint32_t count = 0;
  take(count);
  const auto bytes = take_bytes(count);
  value.assign(bytes.begin(), bytes.end());
}

void FieldReader::take(QuantisedPose& value) {
  for (int32_t& q : value.rotation_q30) take(q);
  for (int32_t& q : value.translation_nm) take(q);
}

}  // namespace ream::record::ops
