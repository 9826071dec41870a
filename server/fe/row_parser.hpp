#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fe/row_places.hpp"
#include "geometry/vec.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::fe {

/// One row `x y z gray`: numbers of its places, as the parser's tables have them.
struct RowRecord {
  std::array<uint16_t, 3> place;
  float gray;
};

/// What is wrong with a row, and where.
struct RowFault {
  uint64_t byte = 0;
  std::string why;
};

/// Reads lines of text rows; one for each thread.
class RowParser {
 public:
  static constexpr size_t longest_line = 4096;

  /// Appends the rows of all lines that begin before `end`, each ended by a line break that follows with 64
  /// readable bytes; `byte` is where `begin` lies in the file. Stops at the first fault.
  std::optional<RowFault> parse(const char* begin, const char* end, uint64_t byte,
                                std::vector<RowRecord>& rows, std::vector<uint64_t>* bytes_of_rows = nullptr);

  std::array<RowPlaces, 3> places;
  voxel::GrayScaleFinder gray;
  std::optional<Vec3> spacing_mm;  ///< from a comment

 private:
  std::optional<std::string> row(const char* at, uint64_t byte, RowRecord& record);
  std::optional<std::string> comment(const char* at, const char* end);
};

}  // namespace ream::fe
