#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ream::test {

/// What somebody reads in one OpenIGTLink message; what its type does not have stays empty.
struct IgtlReading {
  std::string type, name;
  uint64_t stamp = 0;                 ///< 32.32 seconds since 1970
  std::array<float, 12> transform{};  ///< columns: x, y, z, translation
  std::vector<std::array<float, 3>> points, normals;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<double> values;
  uint64_t unit = 0;  ///< as packed
  std::string text;   ///< of STRING and STATUS
  uint16_t code = 0;
  std::string error_name;

  bool operator==(const IgtlReading&) const = default;
};

using IgtlBytes = std::vector<std::byte>;

}  // namespace ream::test
