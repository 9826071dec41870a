#include "reader/row_parser.hpp"

#include <string.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace ream::reader {
namespace {

constexpr size_t min_table_size = 64;
constexpr size_t max_text_bytes = 30;
constexpr double grid_tolerance = 0.08;  // of a voxel, for positions rounded when written
constexpr double same_place = 1e-3;      // of a voxel: two ways to write one position

uint64_t hash_of(const char* text, size_t length) {
  uint64_t hash = length;
  for (size_t i = 0; i < length; ++i) hash = (hash ^ static_cast<unsigned char>(text[i])) * 0x100000001b3u;
  return (hash * 0x9e3779b97f4a7c15u) >> 32;
}

/// std::from_chars, but with a plus before the number, as other programs write it.
std::from_chars_result read_number(const char* from, const char* end, double& number) {
  const bool plus = end - from > 1 && from[0] == '+' && from[1] != '-' && from[1] != '+';
  return std::from_chars(plus ? from + 1 : from, end, number);
}

struct Gap {
  double length = 0.0;
  uint64_t rows = 0;  // of the lesser of its ends
};

std::vector<Gap> gaps_of(const std::vector<RowPlace>& places) {
  std::vector<Gap> gaps;
  for (size_t i = 1; i < places.size(); ++i)
    gaps.push_back({places[i].at - places[i - 1].at, std::min(places[i].rows, places[i - 1].rows)});
  std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.length < b.length; });
  return gaps;
}

/// The gap that half of the rows lie beside.
double typical_gap(const std::vector<Gap>& gaps) {
  uint64_t all = 0, sum = 0;
  for (const Gap& gap : gaps) all += gap.rows;
  for (const Gap& gap : gaps)
    if (2 * (sum += gap.rows) >= all) return gap.length;
  return gaps.back().length;
}

/// One place for those that differ by the way they are written.
void merge_same(std::vector<RowPlace>& places) {
  const double same = same_place * typical_gap(gaps_of(places));
  std::vector<RowPlace> merged{places.front()};
  for (size_t i = 1; i < places.size(); ++i) {
    if (places[i].at - merged.back().at > same) {
      merged.push_back(places[i]);
      continue;
    }
    merged.back().rows += places[i].rows;
    merged.back().first_byte = std::min(merged.back().first_byte, places[i].first_byte);
  }
  places = std::move(merged);
}

/// Small gaps first, so that the step is known well before long gaps are counted in it.
double step_of(const std::vector<RowPlace>& places) {
  const std::vector<Gap> gaps = gaps_of(places);
  const double typical = typical_gap(gaps);
  double length = 0.0, steps = 0.0;
  for (const Gap& gap : gaps) {
    const double step = steps > 0.0 ? length / steps : typical, count = std::nearbyint(gap.length / step);
    if (count < 1.0 || std::abs(gap.length / step - count) > 2.0 * grid_tolerance) continue;
    length += gap.length;
    steps += count;
  }
  return steps > 0.0 ? length / steps : typical;
}

}  // namespace

RowPlaces::RowPlaces() : table_(min_table_size) {}

std::optional<uint16_t> RowPlaces::read(const char*& at, uint64_t line_byte) {
  if (!places_.empty()) {
    const uint16_t guesses[2] = {last_, places_[last_].next};
    for (int k = 0; k < 2; ++k) {
      const uint16_t guess = guesses[k ^ int{moves_}];
      Text& text = places_[guess];
      if (!is(text, at)) continue;
      at += text.length;
      moves_ = guess != last_;
      ++text.place.rows;
      last_ = guess;
      return guess;
    }
  }
  size_t length = 0;
  while (length <= max_text_bytes && !ends_number(at[length])) ++length;
  if (length > max_text_bytes) return {};
  const auto found = look_up(at, length, line_byte);
  if (!found) return {};
  at += length;
  moves_ = *found != last_;
  if (moves_) places_[last_].next = *found;
  ++places_[*found].place.rows;
  last_ = *found;
  return found;
}

std::optional<uint16_t> RowPlaces::look_up(const char* at, size_t length, uint64_t line_byte) {
  size_t slot = hash_of(at, length) % table_.size();
  for (; table_[slot] != 0; slot = (slot + 1) % table_.size()) {
    const Text& text = places_[table_[slot] - 1];
    if (text.length == length && std::memcmp(text.text, at, length) == 0)
      return static_cast<uint16_t>(table_[slot] - 1);
  }
  Text text;
  const auto parsed = read_number(at, at + length, text.place.at);
  if (parsed.ec != std::errc() || parsed.ptr != at + length || !std::isfinite(text.place.at) || full())
    return {};
  std::memcpy(text.text, at, length);
  text.length = static_cast<uint8_t>(length);
  text.place.first_byte = line_byte;
  places_.push_back(text);
  table_[slot] = static_cast<uint32_t>(places_.size());
  if (2 * places_.size() > table_.size()) grow_table();
  return static_cast<uint16_t>(places_.size() - 1);
}

/// A small file must not pay for the table of a large one.
void RowPlaces::grow_table() {
  table_.assign(4 * table_.size(), 0);
  for (size_t i = 0; i < places_.size(); ++i) {
    size_t slot = hash_of(places_[i].text, places_[i].length) % table_.size();
    while (table_[slot] != 0) slot = (slot + 1) % table_.size();
    table_[slot] = static_cast<uint32_t>(i + 1);
  }
}

std::vector<RowPlace> RowPlaces::places() const {
  std::vector<RowPlace> result;
  for (const Text& text : places_) result.push_back(text.place);
  return result;
}

int RowAxis::index(double at) const {
  return count == 1 ? 0 : static_cast<int>(std::floor((at - first) / step + 0.5));
}

RowAxis axis_of(std::vector<RowPlace> places, std::optional<RowPlace>& off) {
  std::sort(places.begin(), places.end(), [](const RowPlace& a, const RowPlace& b) { return a.at < b.at; });
  if (places.size() > 1) merge_same(places);
  if (places.size() == 1) return {places.front().at, 0.0, 1};
  const double step = step_of(places);
  const RowPlace& anchor = *std::max_element(
      places.begin(), places.end(), [](const RowPlace& a, const RowPlace& b) { return a.rows < b.rows; });
  const auto steps_to = [&](const RowPlace& place) { return std::nearbyint((place.at - anchor.at) / step); };
  for (const RowPlace& place : places)
    if (std::abs(place.at - anchor.at - steps_to(place) * step) > grid_tolerance * step)
      if (!off || place.first_byte < off->first_byte) off = place;
  RowAxis axis;
  axis.step = step;
  axis.first = anchor.at + steps_to(places.front()) * step;
  const double count = steps_to(places.back()) - steps_to(places.front()) + 1.0;
  axis.count = static_cast<int>(std::min(count, 2e9));
  return axis;
}

namespace {

constexpr const char* no_row = "is not four finite numbers 'x y z gray'";

bool separates(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

/// False where a number and its line's end do not follow.
bool read_gray(const char* at, float& gray) {
  bool minus = false;
  const char* digit = at;
  if (*digit == '-') minus = true;
  if (*digit == '-' || *digit == '+') ++digit;
  int32_t whole = 0;
  const char* const first = digit;
  while (*digit >= '0' && *digit <= '9' && digit - first < 7) whole = 10 * whole + (*digit++ - '0');
  if (digit != first && (separates(*digit) || *digit == '\n')) {
    gray = static_cast<float>(minus ? -whole : whole);
    at = digit;
  } else {
    double value = 0.0;
    const auto parsed = read_number(at, at + 64, value);
    gray = static_cast<float>(value);
    if (parsed.ec != std::errc() || !std::isfinite(gray)) return false;
    at = parsed.ptr;
  }
  while (separates(*at)) ++at;
  return *at == '\n';
}

}  // namespace

std::optional<RowFault> RowParser::parse(const char* begin, const char* end, uint64_t byte,
                                         std::vector<RowRecord>& rows, std::vector<uint64_t>* bytes_of_rows) {
  for (const char* at = begin; at < end;) {
    const char* const stop = static_cast<const char*>(::rawmemchr(at, '\n'));
    const char* first = at;
    while (separates(*first)) ++first;
    const uint64_t line_byte = byte + static_cast<uint64_t>(at - begin);
    at = stop + 1;
    if (first == stop) continue;
    std::optional<std::string> why;
    if (*first == '#') {
      why = comment(first, stop);
    } else {
      RowRecord record;
      why = row(first, line_byte, record);
      if (!why) {
        rows.push_back(record);
        if (bytes_of_rows != nullptr) bytes_of_rows->push_back(line_byte);
      }
    }
    if (why) return RowFault{line_byte, *why};
  }
  return {};
}

std::optional<std::string> RowParser::row(const char* at, uint64_t byte, RowRecord& record) {
  for (size_t k = 0; k < 3; ++k) {
    while (separates(*at)) ++at;
    const auto place = places[k].read(at, byte);
    if (!place && places[k].full())
      return std::string("more than 65,535 different ") + "xyz"[k] +
             " so far; the rows are on no regular grid";
    if (!place) return no_row;
    record.place[k] = *place;
  }
  while (separates(*at)) ++at;
  if (!read_gray(at, record.gray)) return no_row;
  gray.add(record.gray);
  return {};
}

std::optional<std::string> RowParser::comment(const char* at, const char* end) {
  const std::string_view words(at, static_cast<size_t>(end - at)), key = "# spacing_mm";
  if (!words.starts_with(key)) return {};
  Vec3 spacing;
  at += key.size();
  for (int k = 0; k < 3; ++k) {
    while (at < end && separates(*at)) ++at;
    const auto parsed = read_number(at, end, spacing[k]);
    if (parsed.ec != std::errc() || !(spacing[k] > 0.0) || !std::isfinite(spacing[k]))
      return "'# spacing_mm' needs three positive numbers";
    at = parsed.ptr;
  }
  spacing_mm = spacing;
  return {};
}

}  // namespace ream::reader
