#pragma once
#include <bit>
#include <cstring>
#include <stdexcept>

#include "support/igtl_reading.hpp"

namespace ream::test {

/// Reads OpenIGTLink as its protocol describes it (version 1 headers of 58 bytes, everything big-endian,
/// CRC-64 of ECMA-182), with nothing of any library. Throws std::runtime_error for what is against it.
class IgtlByTheBook {
 public:
  static constexpr size_t header_bytes = 58;

  static uint64_t crc64(const std::byte* data, size_t size) {
    uint64_t crc = 0;
    for (size_t i = 0; i < size; ++i) {
      crc ^= static_cast<uint64_t>(data[i]) << 56;
      for (int bit = 0; bit < 8; ++bit) crc = (crc << 1) ^ ((crc >> 63) != 0 ? 0x42F0E1EBA9EA3693ull : 0);
    }
    return crc;
  }

  /// Bytes of the body, of a message's first header_bytes.
  static uint64_t body_bytes(const IgtlBytes& header) {
    IgtlByTheBook reader(header);
    reader.at_ = 42;
    return reader.whole<uint64_t>();
  }

  static IgtlReading read(const IgtlBytes& message) {
    IgtlByTheBook reader(message);
    return reader.all();
  }

 private:
  explicit IgtlByTheBook(const IgtlBytes& bytes) : bytes_(bytes) {}

  static void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(std::string("OpenIGTLink: ") + what);
  }

  template <typename T>
  T whole() {
    require(at_ + sizeof(T) <= bytes_.size(), "the message is too short");
    T value = 0;
    for (size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value << 8 | static_cast<T>(bytes_[at_++]));
    return value;
  }
  float float32() { return std::bit_cast<float>(whole<uint32_t>()); }
  double float64() { return std::bit_cast<double>(whole<uint64_t>()); }
  std::string text(size_t size) {
    require(at_ + size <= bytes_.size(), "the message is too short");
    std::string all(reinterpret_cast<const char*>(bytes_.data()) + at_, size);
    at_ += size;
    return all.substr(0, all.find('\0'));
  }
  std::array<float, 3> three() {
    std::array<float, 3> values;
    for (float& value : values) value = float32();
    return values;
  }

  IgtlReading all() {
    IgtlReading reading;
    require(whole<uint16_t>() == 1, "the header's version is not 1");
    reading.type = text(12);
    reading.name = text(20);
    reading.stamp = whole<uint64_t>();
    const auto body = whole<uint64_t>(), crc = whole<uint64_t>();
    require(at_ == header_bytes && bytes_.size() == header_bytes + body, "the body's size is wrong");
    require(crc == crc64(bytes_.data() + header_bytes, body), "the checksum is wrong");
    if (reading.type == "TRANSFORM")
      for (float& value : reading.transform) value = float32();
    else if (reading.type == "POLYDATA")
      polydata(reading);
    else if (reading.type == "SENSOR")
      sensor(reading);
    else if (reading.type == "STRING")
      string(reading);
    else if (reading.type == "STATUS")
      status(reading);
    else
      require(false, "unknown type");
    require(at_ == bytes_.size(), "something is left over");
    return reading;
  }

  void polydata(IgtlReading& reading) {
    std::array<uint32_t, 10> counts;
    for (uint32_t& count : counts) count = whole<uint32_t>();
    const auto [points, vertices, vertex_bytes, lines, line_bytes, polygons, polygon_bytes, strips,
                strip_bytes, attributes] = counts;
    require(vertices + vertex_bytes + lines + line_bytes + strips + strip_bytes == 0, "more than triangles");
    for (uint32_t i = 0; i < points; ++i) reading.points.push_back(three());
    const size_t before = at_;
    for (uint32_t i = 0; i < polygons; ++i) {
      require(whole<uint32_t>() == 3, "a polygon is no triangle");
      std::array<uint32_t, 3> corners;
      for (uint32_t& corner : corners) {
        corner = whole<uint32_t>();
        require(corner < points, "a triangle has a corner that is none");
      }
      reading.triangles.push_back(corners);
    }
    require(at_ - before == polygon_bytes, "the polygons' size is wrong");
    if (attributes > 0) normals(reading, attributes);
  }

  /// Attribute heads, then their names (each ended by a zero; one more makes the sum even), then their data.
  void normals(IgtlReading& reading, uint32_t attributes) {
    require(attributes == 1, "more attributes than one");
    require(whole<uint16_t>() == (0x02 << 8 | 3), "the attribute is no normal of 3 components");
    const auto count = whole<uint32_t>();
    const size_t before = at_;
    while (at_ < bytes_.size() && bytes_[at_] != std::byte{0}) ++at_;
    ++at_;
    at_ += (at_ - before) % 2;
    for (uint32_t i = 0; i < count; ++i) reading.normals.push_back(three());
  }

  void sensor(IgtlReading& reading) {
    const auto count = whole<uint8_t>();
    require(whole<uint8_t>() == 0, "the sensor's status is reserved");
    reading.unit = whole<uint64_t>();
    for (int i = 0; i < count; ++i) reading.values.push_back(float64());
  }

  void string(IgtlReading& reading) {
    require(whole<uint16_t>() == 106, "the text is not said to be UTF-8");
    const auto size = whole<uint16_t>();
    reading.text = text(size);
  }

  void status(IgtlReading& reading) {
    reading.code = whole<uint16_t>();
    whole<uint64_t>();
    reading.error_name = text(20);
    require(bytes_.back() == std::byte{0}, "the words do not end");
    reading.text = text(bytes_.size() - at_);
  }

  const IgtlBytes& bytes_;
  size_t at_ = 0;
};

}  // namespace ream::test
