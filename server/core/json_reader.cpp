#include "core/json_reader.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/json.hpp"

namespace ream {
namespace {

std::string short_number(double value) {
  std::string text = nlohmann::json(value).dump();
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

}  // namespace

JsonReader::JsonReader(const nlohmann::json& value, std::string place)
    : value_(&value), place_(std::move(place)) {
  if (!value.is_object()) throw Error(ErrorKind::invalid_input, place_ + " must be a JSON object");
}

void JsonReader::refuse(const std::string& key, const std::string& complaint) const {
  throw Error(ErrorKind::invalid_input, place_ + ": key '" + key + "' " + complaint);
}

bool JsonReader::has(const std::string& key) {
  asked_.insert(key);
  return value_->contains(key);
}

const nlohmann::json& JsonReader::at(const std::string& key) {
  if (!has(key)) refuse(key, "is missing");
  return (*value_)[key];
}

double JsonReader::checked(const std::string& key, const nlohmann::json& value, double min,
                           double max) const {
  if (!value.is_number()) refuse(key, "must be a number");
  const double number = value.get<double>();
  if (!std::isfinite(number)) refuse(key, "must be a finite number");
  if (number < min || number > max) {
    if (max >= 1e300) refuse(key, "is " + short_number(number) + ", must be at least " + short_number(min));
    refuse(key, "is " + short_number(number) + ", must be between " + short_number(min) + " and " +
                    short_number(max));
  }
  return number;
}

double JsonReader::number(const std::string& key, double min, double max) {
  return checked(key, at(key), min, max);
}

double JsonReader::number_or(const std::string& key, double fallback, double min, double max) {
  return has(key) ? number(key, min, max) : fallback;
}

int64_t JsonReader::integer(const std::string& key, int64_t min, int64_t max) {
  const auto& value = at(key);
  if (!value.is_number_integer()) refuse(key, "must be a whole number");
  const bool too_large =
      value.is_number_unsigned() && value.get<uint64_t>() > static_cast<uint64_t>(INT64_MAX);
  if (too_large || value.get<int64_t>() < min || value.get<int64_t>() > max)
    refuse(key,
           "is " + value.dump() + ", must be between " + std::to_string(min) + " and " + std::to_string(max));
  return value.get<int64_t>();
}

int64_t JsonReader::integer_or(const std::string& key, int64_t fallback, int64_t min, int64_t max) {
  return has(key) ? integer(key, min, max) : fallback;
}

uint64_t JsonReader::unsigned_integer(const std::string& key) {
  const auto& value = at(key);
  if (!value.is_number_unsigned()) refuse(key, "must be a whole number of at least 0");
  return value.get<uint64_t>();
}

bool JsonReader::boolean(const std::string& key) {
  const auto& value = at(key);
  if (!value.is_boolean()) refuse(key, "must be true or false");
  return value.get<bool>();
}

bool JsonReader::boolean_or(const std::string& key, bool fallback) {
  return has(key) ? boolean(key) : fallback;
}

std::string JsonReader::text(const std::string& key) {
  const auto& value = at(key);
  if (!value.is_string()) refuse(key, "must be a text");
  return value.get<std::string>();
}

std::string JsonReader::text_or(const std::string& key, const std::string& fallback) {
  return has(key) ? text(key) : fallback;
}

std::vector<double> JsonReader::numbers(const std::string& key, size_t count) {
  const auto& value = at(key);
  if (!value.is_array() || value.size() != count)
    refuse(key, "must be a list of " + std::to_string(count) + " numbers");
  std::vector<double> result;
  for (const auto& entry : value) result.push_back(checked(key, entry, -1e300, 1e300));
  return result;
}

std::vector<double> JsonReader::number_rows(const std::string& key, size_t rows, size_t columns) {
  const auto& value = at(key);
  const std::string rule =
      "must be " + std::to_string(rows) + " lists of " + std::to_string(columns) + " numbers";
  if (!value.is_array() || value.size() != rows) refuse(key, rule);
  std::vector<double> result;
  for (const auto& row : value) {
    if (!row.is_array() || row.size() != columns) refuse(key, rule);
    for (const auto& entry : row) result.push_back(checked(key, entry, -1e300, 1e300));
  }
  return result;
}

std::vector<std::string> JsonReader::texts_or_none(const std::string& key) {
  std::vector<std::string> result;
  if (!has(key)) return result;
  if (!at(key).is_array()) refuse(key, "must be a list of texts");
  for (const auto& entry : at(key)) {
    if (!entry.is_string()) refuse(key, "must be a list of texts");
    result.push_back(entry.get<std::string>());
  }
  return result;
}

JsonReader JsonReader::object(const std::string& key) { return {at(key), place_ + "." + key}; }

std::vector<JsonReader> JsonReader::objects(const std::string& key) {
  const auto& value = at(key);
  if (!value.is_array()) refuse(key, "must be a list");
  std::vector<JsonReader> result;
  for (size_t i = 0; i < value.size(); ++i)
    result.emplace_back(value[i], place_ + "." + key + "[" + std::to_string(i) + "]");
  return result;
}

void JsonReader::finish() const {
  for (const auto& [key, ignored] : value_->items())
    if (!asked_.contains(key)) refuse(key, "is unknown");
}

}  // namespace ream
