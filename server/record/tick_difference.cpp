#include "record/tick_difference.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstring>
#include <sstream>

#include "core/hash.hpp"

namespace ream::record {
namespace {

using ops::Tick;

/// What a field tells of, and when it is compared: the lowest place first.
struct Subject {
  std::string_view beginning;  ///< of the field's name
  const char* kind;
  int place;
  bool has_vibration = false;
};

constexpr std::array subjects{Subject{"tick", "order", 0},
                              Subject{"world_from_", "pose", 1},
                              Subject{"grid_from_", "pose", 1},
                              Subject{"removed_", "bone", 2},
                              Subject{"changed_bricks", "bone", 2},
                              Subject{"engaged_points", "contact", 2},
                              Subject{"session_hash", "bone", 3},
                              Subject{"surface_temperature_", "heat", 4},
                              Subject{"feed_rate_", "contact", 4},
                              Subject{"density_", "contact", 4},
                              Subject{"share_", "contact", 4},
                              Subject{"vibration_", "vibration", 5, true},
                              Subject{"hand_vibration_", "vibration", 6, true},
                              Subject{"hand_force_", "force", 7, true},
                              Subject{"flags", "contact", 8},
                              Subject{"", "force", 4}};

const Subject& subject_of(std::string_view field) {
  return *std::find_if(subjects.begin(), subjects.end(),
                       [&](const Subject& subject) { return field.starts_with(subject.beginning); });
}

std::string words(uint64_t hash) { return to_hex(hash); }
std::string words(std::integral auto value) { return std::to_string(value); }
std::string words(float value) {
  std::ostringstream text;
  text.precision(9);
  text << value;
  return text.str();
}

template <typename Number>
Difference difference_of(const char* kind, const std::string& name, const Number& recorded,
                         const Number& found) {
  return {kind, name, words(recorded), words(found)};
}

/// The part of a pose that differs, in its own units.
Difference difference_of(const char* kind, const std::string& name, const QuantisedPose& recorded,
                         const QuantisedPose& found) {
  for (size_t i = 0; i < 3; ++i)
    if (const int32_t a = recorded.translation_nm[i], b = found.translation_nm[i]; a != b)
      return difference_of(kind, name + "." + "xyz"[i] + "_nm", a, b);
  size_t i = 0;
  while (i < 8 && recorded.rotation_q30[i] == found.rotation_q30[i]) ++i;
  return difference_of(kind, name + ".rotation_q30[" + std::to_string(i) + "]", recorded.rotation_q30[i],
                       found.rotation_q30[i]);
}

}  // namespace

std::optional<Difference> first_difference(const Tick& recorded, const Tick& found, Columns columns) {
  std::optional<Difference> first;
  size_t at = 0;
  int place = 0;  ///< of the first
  Tick::visit_fields(recorded, [&]<typename Field>(const Field& a, uint32_t) {
    const std::string_view name = Tick::field_names[at++];
    const auto offset =
        reinterpret_cast<const std::byte*>(&a) - reinterpret_cast<const std::byte*>(&recorded);
    Field b;
    std::memcpy(&b, reinterpret_cast<const std::byte*>(&found) + offset, sizeof b);
    if (std::memcmp(&a, &b, sizeof a) == 0) return;
    const Subject& subject = subject_of(name);
    if (first && subject.place >= place) return;
    if (subject.has_vibration && columns == Columns::without_vibration) return;
    place = subject.place;
    first = difference_of(subject.kind, std::string(name), a, b);
  });
  return first;
}

}  // namespace ream::record
