// Messages byte by byte as the protocol describes them, and as two readers read them.
#include "openigtlink/messages.hpp"

#include <gtest/gtest.h>

#include "support/igtl_by_the_book.hpp"
#include "support/slicer_client.hpp"

namespace ream::openigtlink {
namespace {

using test::IgtlBytes;
using test::IgtlByTheBook;
using test::IgtlReading;

constexpr int64_t second_and_a_half = 1'500'000'000;

/// What two readers agree upon.
IgtlReading read(const Message& message) {
  const IgtlReading by_book = IgtlByTheBook::read(*message);
  EXPECT_EQ(by_book, test::read_by_library(*message));
  return by_book;
}

/// Bytes as people write them: hexadecimal, blanks between.
IgtlBytes bytes_of(const std::string& hex) {
  IgtlBytes bytes;
  std::string digits;
  for (const char c : hex)
    if (c != ' ' && c != '\n') digits += c;
  for (size_t i = 0; i < digits.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::string hex_of(const IgtlBytes& bytes) {
  std::string hex;
  for (const std::byte b : bytes) {
    hex += "0123456789abcdef"[static_cast<unsigned>(b) >> 4];
    hex += "0123456789abcdef"[static_cast<unsigned>(b) & 15];
  }
  return hex;
}

IgtlBytes part(const Message& message, size_t first, size_t count) {
  return {message->begin() + static_cast<ptrdiff_t>(first),
          message->begin() + static_cast<ptrdiff_t>(first + count)};
}

void expect_bytes(const Message& message, size_t first, const std::string& hex) {
  const IgtlBytes wanted = bytes_of(hex);
  ASSERT_GE(message->size(), first + wanted.size());
  EXPECT_EQ(hex_of(part(message, first, wanted.size())), hex_of(wanted));
}

TEST(OpenIgtlinkMessages, ChecksumIsThatOfEcma182) {
  // The check value of CRC-64/ECMA-182.
  const std::string digits = "123456789";
  EXPECT_EQ(IgtlByTheBook::crc64(reinterpret_cast<const std::byte*>(digits.data()), digits.size()),
            0x6C40DF5F0B497347ull);
}

TEST(OpenIgtlinkMessages, TransformHasItsColumnsOneAfterTheOther) {
  Pose quarter_turn_about_z;
  quarter_turn_about_z.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  quarter_turn_about_z.translation_mm = {1.0, 2.0, -3.5};
  const Message message = transform_message({"ReamerToRas", second_and_a_half}, quarter_turn_about_z);
  ASSERT_EQ(message->size(), 58u + 48u);
  expect_bytes(message, 0,
               "0001"                                      // version
               "5452414e53464f524d000000"                  // TRANSFORM
               "5265616d6572546f526173000000000000000000"  // ReamerToRas
               "00000001");                                // seconds
  // Half a second is 2^31 / 2^32; the library goes by way of whole nanoseconds.
  const uint64_t stamp = IgtlByTheBook::read(*message).stamp;
  EXPECT_NEAR(static_cast<double>(stamp) * 0x1p-32, 1.5, 1e-8);
  expect_bytes(message, 42, "0000000000000030");
  expect_bytes(message, 58,
               "00000000 3f800000 00000000"    // x axis
               "bf800000 00000000 00000000"    // y axis
               "00000000 00000000 3f800000"    // z axis
               "3f800000 40000000 c0600000");  // translation
  const IgtlReading reading = read(message);
  EXPECT_EQ(reading.name, "ReamerToRas");
  EXPECT_EQ(reading.transform, (std::array<float, 12>{0, 1, 0, -1, 0, 0, 0, 0, 1, 1, 2, -3.5f}));
}

TEST(OpenIgtlinkMessages, SensorSaysItsUnit) {
  const std::array<double, 2> force_n{52.0, 2.0};
  const Message force = sensor_message({"Force", second_and_a_half}, force_n, SensorUnit::newton);
  // Prefix none (4 bits), newton (6) with exponent 1 (4), five empty fields of 10 bits.
  expect_bytes(force, 58,
               "02 00 02c4000000000000"
               "404a000000000000 4000000000000000");
  EXPECT_EQ(read(force).values, (std::vector<double>{52.0, 2.0}));
  const std::array<double, 1> torque_n_m{0.25};
  const Message torque = sensor_message({"Torque", 0}, torque_n_m, SensorUnit::newton_metre);
  const uint64_t unit = read(torque).unit;
  EXPECT_EQ(unit >> 60, 0u);
  EXPECT_EQ(unit >> 54 & 0x3f, 0x0Bu) << "newton";
  EXPECT_EQ(unit >> 50 & 0xf, 1u);
  EXPECT_EQ(unit >> 44 & 0x3f, 0x01u) << "metre";
  EXPECT_EQ(unit >> 40 & 0xf, 1u);
  EXPECT_EQ(unit & 0xffffffffff, 0u);
}

TriangleMesh one_triangle() {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

TEST(OpenIgtlinkMessages, PolydataOfATriangle) {
  const Message message = polydata_message({"Bone", second_and_a_half}, one_triangle());
  ASSERT_EQ(message->size(), 58u + 92u);
  expect_bytes(message, 2, "504f4c594441544100000000");  // POLYDATA
  expect_bytes(message, 58,
               "00000003 00000000 00000000 00000000 00000000"  // points; vertices, their bytes; lines, theirs
               "00000001 00000010 00000000 00000000 00000000"  // polygons, their bytes; strips; attributes
               "00000000 00000000 00000000  3f800000 00000000 00000000  00000000 40000000 00000000"
               "00000003 00000000 00000001 00000002");
  const IgtlReading reading = read(message);
  EXPECT_EQ(reading.points.size(), 3u);
  EXPECT_EQ(reading.triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}}));
}

TEST(OpenIgtlinkMessages, PolydataWithNormals) {
  TriangleMesh mesh = one_triangle();
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 1, 0}};
  const Message message = polydata_message({"Bone", second_and_a_half}, mesh);
  expect_bytes(message, 58 + 36, "00000001");
  // Head: normals, 3 components, how many; name, its zero; data.
  expect_bytes(message, 58 + 92, "02 03 00000003 4e6f726d616c7300 00000000 00000000 3f800000");
  const IgtlReading reading = read(message);
  EXPECT_EQ(reading.normals, (std::vector<std::array<float, 3>>{{0, 0, 1}, {0, 0, 1}, {0, 1, 0}}));
}

TEST(OpenIgtlinkMessages, WordsAndStatus) {
  const Message words = string_message({"Session", second_and_a_half}, "Schulter l\xC3\xA4nks");
  expect_bytes(words, 58, "006a 000f");
  EXPECT_EQ(read(words).text, "Schulter l\xC3\xA4nks");
  const Message status =
      status_message({"Simulator", second_and_a_half}, StatusCode::hardware_failure, "fault", "no hand");
  expect_bytes(status, 58, "0012 0000000000000000 6661756c74000000000000000000000000000000 6e6f2068616e6400");
  const IgtlReading reading = read(status);
  EXPECT_EQ(reading.code, 18);
  EXPECT_EQ(reading.error_name, "fault");
  EXPECT_EQ(reading.text, "no hand");
}

TEST(OpenIgtlinkMessages, NamesThatAreTooLongAreCut) {
  const std::string name(40, 'n');
  EXPECT_EQ(read(polydata_message({name, 0}, one_triangle())).name, name.substr(0, 20));
  EXPECT_EQ(read(polydata_message({"", 0}, TriangleMesh{})).points.size(), 0u) << "an empty surface";
}

}  // namespace
}  // namespace ream::openigtlink
