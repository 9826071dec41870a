#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "device/profiles.hpp"
#include "device/script/script.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"

namespace ream::device {
namespace {

using nlohmann::json;

std::string parser_complaint(const json& script) {
  try {
    parse_script(script, "script");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

/// proto/script.schema.json and the parser say the same of each: what one takes the other takes.
class ScriptSchema : public testing::Test {
 protected:
  static std::vector<std::string> faults(const json& script) {
    const json schema = read_json_file(test::source_folder() + "/proto/script.schema.json");
    return test::schema_faults(schema, script);
  }
};

class GoodScript : public ScriptSchema, public testing::WithParamInterface<const char*> {};

TEST_P(GoodScript, IsTakenByBoth) {
  const json script = json::parse(GetParam());
  EXPECT_EQ(faults(script), std::vector<std::string>{});
  EXPECT_EQ(parser_complaint(script), "");
}

INSTANTIATE_TEST_SUITE_P(
    Scripts, GoodScript,
    testing::Values(
        R"({"device": "hand", "duration_s": 1, "hand": {"force_profile": [{"t_s": 0, "force_n": 50}]}})",
        R"({"device": "hand", "duration_s": 14400, "force_scale": 0.01, "stiffness_n_mm": 0, "spindle_rpm": 1, "specimen_factor": 0.1,
            "hand": {"start_mm": [0, 0, -5], "tilt_deg": [1, 2, 3], "mass_kg": 0.05, "arm_damping_n_s_mm": 100,
                     "guide_stiffness_n_mm": 0, "force_profile": [{"t_s": 14400, "force_n": -500}]}})",
        R"({"device": "poses", "duration_s": 0.001, "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 2,
            "poses": [{"t_s": 0, "position_mm": [0, 0, -1]}, {"t_s": 1, "rotation_deg": [0, 5, 0]}],
            "buttons": []})",
        R"({"device": "poses", "duration_s": 1, "mount": "chest_wall", "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 1, "mount": "rigid", "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "mount": {"stiffness_n_mm": [1, 2, 3], "damping_n_s_mm": [0, 0, 0.5],
                      "angular_stiffness_n_mm_rad": [1e4, 1e4, 2e4], "angular_damping_n_mm_s_rad": [0, 1, 2]}})",
        R"({"device": "poses", "duration_s": 2, "poses": [{"t_s": 0}],
            "buttons": [{"t_s": 0.5, "spindle": false}, {"t_s": 1, "pause": true}]})",
        R"({"device": "hand", "device_profile": "sigma.7", "duration_s": 1,
            "hand": {"force_profile": [{"t_s": 0, "force_n": 50}], "arm_stiffness_n_mm": 1, "tremor_rms_n": 2,
                     "correction_gain": 0.5, "reaction_time_s": 0.15, "grip_stiffness_n_mm": 4,
                     "grip_damping_n_s_mm": 0.05,
                     "wrist": {"stiffness_n_mm_rad": 1000, "damping_n_mm_s_rad": 100, "inertia_kg_mm2": 5000}}})",
        R"({"device": "hand", "device_profile": "hapticmaster", "duration_s": 1,
            "hand": {"force_profile": [{"t_s": 0, "force_n": 50}], "wrist": {}}})",
        R"({"device": "robot", "duration_s": 1, "robot": {}})",
        R"({"device": "robot", "device_profile": "hapticmaster", "duration_s": 60,
            "robot": {"start_mm": [0, 0, -2], "tilt_deg": [1, 0, 0], "approach_mm_s": 1, "force_n": 52, "ramp_s": 5,
                      "depth_mm": 0.5, "line_stiffness_n_mm": 500}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "vibration": {}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "vibration": {"source": "off", "n_per_g": 0}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "vibration": {"source": "recording", "cortical_file": "a.wav", "cancellous_file": "b.csv",
                          "idle_file": "c.csv", "rate_hz": 22050, "n_per_g": 5}})"));

class BadScript : public ScriptSchema, public testing::WithParamInterface<const char*> {};

TEST_P(BadScript, IsRefusedByBoth) {
  const json script = json::parse(GetParam());
  EXPECT_NE(faults(script), std::vector<std::string>{});
  EXPECT_NE(parser_complaint(script), "");
}

INSTANTIATE_TEST_SUITE_P(
    Scripts, BadScript,
    testing::Values(
        "[]", "{}", R"({"device": "hand", "duration_s": 1})", R"({"device": "poses", "duration_s": 1})",
        R"({"device": "foot", "duration_s": 1, "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 0, "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": "1", "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 14401, "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 1, "poses": []})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": -1}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 14401}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"position_mm": [0, 0, 0]}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0, "position_mm": [0, 0]}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0, "pose": 1}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "force_scale": 1001})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "specimen_factor": 0.05})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "specimen_factor": 11})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "durtion_s": 1})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "buttons": [{"spindle": true}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "buttons": [{"t_s": 0, "pause": 1}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "hand": {"force_profile": [{"t_s": 0, "force_n": 1}]}})",
        R"({"device": "poses", "duration_s": 1, "mount": "table", "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 1, "mount": {"stiffness_n_mm": [1, 2, 3]}, "poses": [{"t_s": 0}]})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "mount": {"stiffness_n_mm": [1, 0, 3], "damping_n_s_mm": [0, 0, 0],
                      "angular_stiffness_n_mm_rad": [1, 1, 1], "angular_damping_n_mm_s_rad": [0, 0, 0]}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "mount": {"stiffness_n_mm": [1, 1, 1], "damping_n_s_mm": [0, -1, 0],
                      "angular_stiffness_n_mm_rad": [1, 1, 1], "angular_damping_n_mm_s_rad": [0, 0, 0]}})",
        R"({"device": "hand", "duration_s": 1, "hand": {"force_profile": []}})",
        R"({"device": "hand", "duration_s": 1, "hand": {"force_profile": [{"t_s": 0, "force_n": 501}]}})",
        R"({"device": "hand", "duration_s": 1, "hand": {"force_profile": [{"t_s": 0, "force_n": 1}], "mass_kg": 0}})",
        R"({"device": "hand", "duration_s": 1, "hand": {"force_profile": [{"t_s": 0, "force_n": 1}]},
            "poses": [{"t_s": 0}]})",
        R"({"device": "hand", "duration_s": 1, "hand": {"force_profile": [{"t_s": 0, "force_n": 1}]}, "robot": {}})",
        R"({"device": "hand", "duration_s": 1,
            "hand": {"force_profile": [{"t_s": 0, "force_n": 1}], "correction_gain": 1}})",
        R"({"device": "hand", "duration_s": 1,
            "hand": {"force_profile": [{"t_s": 0, "force_n": 1}], "wrist": {"stiffness_n_mm": 1}}})",
        R"({"device": "hand", "device_profile": "omega", "duration_s": 1,
            "hand": {"force_profile": [{"t_s": 0, "force_n": 1}]}})",
        R"({"device": "hand", "stiffness_n_mm": 101, "duration_s": 1,
            "hand": {"force_profile": [{"t_s": 0, "force_n": 1}]}})",
        R"({"device": "robot", "duration_s": 1})",
        R"({"device": "robot", "duration_s": 1, "robot": {}, "poses": [{"t_s": 0}]})",
        R"({"device": "robot", "duration_s": 1, "robot": {"depth_mm": 0}})",
        R"({"device": "robot", "duration_s": 1, "robot": {"line_stiffness_n_mm": 1001}})",
        R"({"device": "robot", "duration_s": 1, "robot": {"hand": 1}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "vibration": "off"})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "vibration": {"source": "none"}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "vibration": {"volume": 1}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "vibration": {"n_per_g": 21}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}], "vibration": {"rate_hz": 22050}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "vibration": {"source": "recording", "cortical_file": "a.wav"}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "vibration": {"source": "recording", "cortical_file": "", "cancellous_file": "b.csv"}})",
        R"({"device": "poses", "duration_s": 1, "poses": [{"t_s": 0}],
            "vibration": {"source": "recording", "cortical_file": "a.wav", "cancellous_file": "b.csv",
                          "rate_hz": 999}})"));

TEST_F(ScriptSchema, KnowsEveryDeviceProfile) {
  const json schema = read_json_file(test::source_folder() + "/proto/script.schema.json");
  EXPECT_EQ(schema["properties"]["device_profile"]["enum"], json(device_profile_names()));
}

}  // namespace
}  // namespace ream::device
