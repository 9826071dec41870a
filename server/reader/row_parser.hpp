#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "geometry/vec.hpp"
#include "voxel/gray_scale.hpp"

namespace ream::reader {

/// A position along one axis as text rows give it.
struct RowPlace {
  double at = 0.0;
  uint64_t first_byte = 0;  ///< of the first line that has it
  uint64_t rows = 0;
};

/// The different texts of one axis' positions, numbered as they are met. Most are recognised by the row
/// before: the same once more, or the one that followed it the last time, so that few are parsed as numbers.
class RowPlaces {
 public:
  static constexpr size_t most = 65535;

  RowPlaces();

  /// The number of the text at `at`, which must be followed by 32 bytes that may be read; advances `at`
  /// behind it. Empty when it is no finite number or there are too many different ones (then full()).
  std::optional<uint16_t> read(const char*& at, uint64_t line_byte);
  bool full() const { return places_.size() >= most; }

  std::vector<RowPlace> places() const;

 private:
  struct Text {
    char text[31] = {};
    uint8_t length = 0;
    uint16_t next = 0;  ///< that followed it the last time
    RowPlace place;
  };
  bool is(const Text& text, const char* at) const {
    return std::memcmp(at, text.text, text.length) == 0 && ends_number(at[text.length]);
  }
  static bool ends_number(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r' || c == '\n';
  }
  void grow_table();
  std::optional<uint16_t> look_up(const char* at, size_t length, uint64_t line_byte);

  std::vector<Text> places_;
  std::vector<uint32_t> table_;  ///< number + 1 of a text's slot
  uint16_t last_ = 0;
  bool moves_ = false;  ///< the last row had another position than the one before
};

/// Positions of a regular grid along one axis: first + i * step for i below count.
struct RowAxis {
  double first = 0.0, step = 0.0;  ///< step 0: a single position
  int count = 0;

  int index(double at) const;
};

/// The grid that the positions lie on: its step is what most rows have between neighbours, others may be
/// missing in between. `off` is set to a place that lies on no such grid. Needs a place.
RowAxis axis_of(std::vector<RowPlace> places, std::optional<RowPlace>& off);

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
  static constexpr size_t max_line_bytes = 4096;

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

}  // namespace ream::reader
