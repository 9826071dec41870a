#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace ream {

/// Strict reading of one JSON object: every key is asked for by name and type, and finish() refuses any key
/// that nobody asked for. All errors are Error invalid_input of the form "<place>: key 'depth_mm' must be
/// ...". The JSON value must outlive the reader.
class JsonReader {
 public:
  /// `place` names the file (and the path inside it) for people. Throws when `value` is not an object.
  JsonReader(const nlohmann::json& value, std::string place);

  /// True when the key is there; counts as asked for.
  bool has(const std::string& key);

  /// Finite numbers. Throws when the key is missing, of another type, or outside [min, max].
  double number(const std::string& key, double min = -1e300, double max = 1e300);
  double number_or(const std::string& key, double fallback, double min = -1e300, double max = 1e300);
  int64_t integer(const std::string& key, int64_t min = INT64_MIN, int64_t max = INT64_MAX);
  int64_t integer_or(const std::string& key, int64_t fallback, int64_t min = INT64_MIN,
                     int64_t max = INT64_MAX);
  /// A whole number from 0 to 2^64 - 1.
  uint64_t unsigned_integer(const std::string& key);
  bool boolean(const std::string& key);
  bool boolean_or(const std::string& key, bool fallback);
  std::string text(const std::string& key);
  std::string text_or(const std::string& key, const std::string& fallback);
  /// An array of exactly `count` finite numbers.
  std::vector<double> numbers(const std::string& key, size_t count);
  /// An array of `rows` arrays of `columns` finite numbers each; row after row.
  std::vector<double> number_rows(const std::string& key, size_t rows, size_t columns);
  std::vector<std::string> texts_or_none(const std::string& key);

  JsonReader object(const std::string& key);
  std::vector<JsonReader> objects(const std::string& key);

  /// Throws naming the first key that was never asked for.
  void finish() const;

  const std::string& place() const { return place_; }
  /// Throws Error invalid_input "<place>: key '<key>' <complaint>".
  [[noreturn]] void refuse(const std::string& key, const std::string& complaint) const;

 private:
  const nlohmann::json& at(const std::string& key);
  double checked(const std::string& key, const nlohmann::json& value, double min, double max) const;

  const nlohmann::json* value_;
  std::string place_;
  std::set<std::string> asked_;
};

}  // namespace ream
