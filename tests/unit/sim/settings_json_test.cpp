#include "sim/settings.hpp"
#include "support/places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>

#include "core/file.hpp"
#include "device/profiles.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"

namespace ream::sim {
namespace {

using nlohmann::json;

/// Every number of every object replaced by one that needs all of its bits.
void scramble(json& value, std::mt19937_64& random) {
  if (value.is_structured())
    for (auto& inner : value) scramble(inner, random);
  else if (value.is_number_float())
    value = std::uniform_real_distribution<double>(1e-3, 1e3)(random);
  else if (value.is_number_unsigned())
    value = random() | 1ull << 63;
}

json full_settings() {
  Settings settings;
  fit_to_device(device::device_profile("hapticmaster"), 0.0, settings);
  settings.mount = device::chest_wall_mount;
  settings.vibration.recordings.cortical = "/somewhere/co\"rtical.wav";
  settings.removal = RemovalLaw::decay;
  settings.feed.kind = force::FeedKind::oblique;
  return to_json(settings);
}

TEST(SettingsJson, KeepEveryBitOfEveryNumber) {
  const uint32_t seed = test::seed(20261);
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  for (int turn = 0; turn < 200; ++turn) {
    json wanted = full_settings();
    scramble(wanted, random);
    const std::string text = wanted.dump();
    const Settings read = settings_from_json(json::parse(text), "test");
    ASSERT_EQ(to_json(read).dump(), text);
    ASSERT_EQ(read.random_seed, wanted.at("random_seed").get<uint64_t>());
    ASSERT_EQ(read.feed.cutting.friction, wanted.at("feed").at("cutting").at("friction").get<double>());
  }
}

TEST(SettingsJson, NameThePluginWhoseFeedModelItIsAndNoneElse) {
  Settings settings;
  EXPECT_FALSE(to_json(settings).at("feed").contains("plugin")) << "as before there were any";
  EXPECT_FALSE(settings_from_json(to_json(settings), "test").feed.plugin.has_value());
  settings.feed.plugin = PluginIdentity{"softbone", "1.2", std::string(64, 'a')};
  EXPECT_EQ(settings_from_json(to_json(settings), "test").feed.plugin, settings.feed.plugin);
}

TEST(SettingsJson, TellWhatIsThereFromWhatIsNot) {
  Settings settings;
  EXPECT_FALSE(settings_from_json(to_json(settings), "test").virtual_mass.has_value());
  EXPECT_FALSE(settings_from_json(to_json(settings), "test").mount.has_value());
  settings.virtual_mass.emplace().mass_kg = 3.25;
  settings.mount = device::chest_wall_mount;
  const Settings read = settings_from_json(to_json(settings), "test");
  EXPECT_EQ(read.virtual_mass->mass_kg, 3.25);
  EXPECT_EQ(read.mount->angular_damping_n_mm_s_rad, settings.mount->angular_damping_n_mm_s_rad);
}

/// "test.feed.kind" -> "/feed/kind"
std::string pointer_of(std::string path) {
  path.erase(0, std::string("test").size());
  std::replace(path.begin(), path.end(), '.', '/');
  return path;
}

/// What a key is when nobody says it: null within parts that are not there by default.
json default_at(const json::json_pointer& place) {
  Settings settings;
  settings.physics = 1;  // of recordings from before it was written
  const json without_parts = to_json(settings);
  if (without_parts.contains(place)) return without_parts.at(place);
  settings.virtual_mass.emplace();
  settings.mount.emplace();
  return to_json(settings).at(place);
}

/// Calls `each` with every object inside `value` and its path.
void for_each_object(json& value, const std::string& path,
                     const std::function<void(json&, const std::string&)>& each) {
  each(value, path);
  for (auto& [key, inner] : value.items())
    if (inner.is_object()) for_each_object(inner, path + "." + key, each);
}

TEST(SettingsJson, AMissingKeyKeepsItsDefaultAndUnknownOnesAreRefusedByName) {
  json settings = full_settings();
  int objects = 0;
  for_each_object(settings, "test", [&](json& object, const std::string& path) {
    ++objects;
    const json whole = object;
    for (const auto& [key, ignored] : whole.items()) {
      object.erase(key);
      const json read = to_json(settings_from_json(settings, "test"));
      const json::json_pointer place(pointer_of(path) + "/" + key);
      EXPECT_TRUE(read.contains(place)) << place;
      EXPECT_EQ(read.at(place), default_at(place)) << place;
      object = whole;
    }
    object["colour"] = 1;
    test::expect_error(ErrorKind::invalid_input, path + ": key 'colour' is unknown",
                       [&] { settings_from_json(settings, "test"); });
    object = whole;
  });
  EXPECT_EQ(objects, 9);
}

/// Settings as the first recordings that can be computed again hold them. Later builds must read them, and
/// may say more but nothing else.
TEST(SettingsJson, ThoseOfTheFirstRecordingsAreReadAsTheyWere) {
  const json golden = read_json_file(test::source_folder() + "/proto/golden/recording_settings.json");
  const json read = to_json(settings_from_json(golden, "golden"));
  json merged = read;
  merged.merge_patch(golden);
  EXPECT_EQ(merged, read);
}

TEST(SettingsJson, RefuseWordsThatMeanNothing) {
  json settings = full_settings();
  settings["removal"] = "chisel";
  test::expect_error(ErrorKind::invalid_input, "key 'removal'",
                     [&] { settings_from_json(settings, "test"); });
}

TEST(SettingsJson, NumbersThatNoTickSurvivesAreRefused) {
  Settings whole;
  whole.spindle.emplace();
  for (const char* path : {"/feed/spindle_rad_s", "/spindle/stall_torque_n_mm",
                           "/spindle/droop_rad_s_per_n_mm", "/spindle/inertia_kg_mm2", "/spindle/start_s",
                           "/spindle/coast_s", "/spindle/catch_ratio", "/spindle/mass_kg",
                           "/heat/conductivity_w_m_k", "/heat/heat_capacity_mj_m3_k", "/heat/least_area_mm2"})
    for (const double value : {0.0, -1.0}) {
      json settings = to_json(whole);
      settings[json::json_pointer(path)] = value;
      test::expect_error(ErrorKind::invalid_input, "must be above 0",
                         [&] { settings_from_json(settings, "test"); });
    }
}

}  // namespace
}  // namespace ream::sim
