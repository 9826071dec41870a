#include "record/tick_difference.hpp"

#include <array>
#include <bit>
#include <concepts>
#include <sstream>

#include "core/hash.hpp"
#include "geometry/pose.hpp"

namespace ream::record {
namespace {

using ops::Tick;

/// A column of numbers or poses.
template <typename Value>
struct Column {
  const char *kind, *name;
  Value Tick::*value;
  bool is_vibration = false;
};

constexpr std::array<Column<QuantisedPose>, 3> poses{
    {{"pose", "world_from_handle", &Tick::world_from_handle},
     {"pose", "grid_from_tool", &Tick::grid_from_tool},
     {"pose", "world_from_bone_rest", &Tick::world_from_bone_rest}}};

constexpr std::array<Column<int32_t>, 3> removed_columns{
    {{"bone", "removed_cancellous", &Tick::removed_cancellous},
     {"bone", "removed_cortical", &Tick::removed_cortical},
     {"bone", "removed_cartilage", &Tick::removed_cartilage}}};

constexpr std::array<Column<uint32_t>, 2> counts{{{"bone", "changed_bricks", &Tick::changed_bricks},
                                                  {"contact", "engaged_points", &Tick::engaged_points}}};

constexpr std::array<Column<float>, 21> results{
    {{"force", "thrust_n", &Tick::thrust_n},
     {"force", "torque_n_mm", &Tick::torque_n_mm},
     {"force", "spindle_torque_n_mm", &Tick::spindle_torque_n_mm},
     {"force", "guide_force_n", &Tick::guide_force_n},
     {"force", "spindle_speed_rad_s", &Tick::spindle_speed_rad_s},
     {"heat", "surface_temperature_c", &Tick::surface_temperature_c},
     {"contact", "feed_rate_mm_s", &Tick::feed_rate_mm_s},
     {"contact", "density_g_cc", &Tick::density_g_cc},
     {"contact", "share_cancellous", &Tick::share_cancellous},
     {"contact", "share_cortical", &Tick::share_cortical},
     {"contact", "share_cartilage", &Tick::share_cartilage},
     {"force", "hand_torque_x_n_mm", &Tick::hand_torque_x_n_mm},
     {"force", "hand_torque_y_n_mm", &Tick::hand_torque_y_n_mm},
     {"force", "hand_torque_z_n_mm", &Tick::hand_torque_z_n_mm},
     {"vibration", "vibration_g", &Tick::vibration_g, true},
     {"vibration", "hand_vibration_x_n", &Tick::hand_vibration_x_n, true},
     {"vibration", "hand_vibration_y_n", &Tick::hand_vibration_y_n, true},
     {"vibration", "hand_vibration_z_n", &Tick::hand_vibration_z_n, true},
     {"force", "hand_force_x_n", &Tick::hand_force_x_n, true},
     {"force", "hand_force_y_n", &Tick::hand_force_y_n, true},
     {"force", "hand_force_z_n", &Tick::hand_force_z_n, true}}};

std::string words(std::integral auto value) { return std::to_string(value); }

std::string words(float value) {
  std::ostringstream text;
  text.precision(9);
  text << value;
  return text.str();
}

/// The part of a pose that differs, in its own units.
Difference pose_difference(const Column<QuantisedPose>& column, const QuantisedPose& recorded,
                           const QuantisedPose& found) {
  constexpr const char* axes[3] = {".x_nm", ".y_nm", ".z_nm"};
  for (size_t i = 0; i < 3; ++i)
    if (recorded.translation_nm[i] != found.translation_nm[i])
      return {column.kind, std::string(column.name) + axes[i], words(recorded.translation_nm[i]),
              words(found.translation_nm[i])};
  size_t i = 0;
  while (i < 8 && recorded.rotation_q30[i] == found.rotation_q30[i]) ++i;
  return {column.kind, std::string(column.name) + ".rotation_q30[" + std::to_string(i) + "]",
          words(recorded.rotation_q30[i]), words(found.rotation_q30[i])};
}

template <size_t Count, typename Value>
std::optional<Difference> number_difference(const std::array<Column<Value>, Count>& columns,
                                            const Tick& recorded, const Tick& found, Columns compared) {
  for (const Column<Value>& column : columns) {
    if (column.is_vibration && compared == Columns::without_vibration) continue;
    const Value a = recorded.*column.value, b = found.*column.value;
    if (std::bit_cast<uint32_t>(a) != std::bit_cast<uint32_t>(b))
      return Difference{column.kind, column.name, words(a), words(b)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Difference> first_difference(const Tick& recorded, const Tick& found, Columns columns) {
  if (recorded.tick != found.tick)
    return Difference{"order", "tick", words(recorded.tick), words(found.tick)};
  for (const auto& column : poses)
    if (const auto& a = recorded.*column.value, &b = found.*column.value; a != b)
      return pose_difference(column, a, b);
  if (auto difference = number_difference(removed_columns, recorded, found, columns)) return difference;
  if (auto difference = number_difference(counts, recorded, found, columns)) return difference;
  if (recorded.session_hash != found.session_hash)
    return Difference{"bone", "session_hash", to_hex(recorded.session_hash), to_hex(found.session_hash)};
  if (auto difference = number_difference(results, recorded, found, columns)) return difference;
  if (recorded.flags != found.flags)
    return Difference{"contact", "flags", words(recorded.flags), words(found.flags)};
  return std::nullopt;
}

}  // namespace ream::record
