#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"

namespace ream::case_ {

/// Sphere that fits the articular surface of the humeral head. World frame (LPS mm).
struct HumeralHead {
  Vec3 centre_mm = Vec3::Zero();
  double radius_mm = 24.0;

  bool operator==(const HumeralHead&) const = default;
};

/// Points of the scapula that version, inclination and the plan are measured from. World frame (LPS mm); any
/// of them may be missing. Rim points lie on native bone, not on osteophytes.
struct Landmarks {
  std::optional<Vec3> glenoid_centre_mm, superior_rim_mm, inferior_rim_mm, anterior_rim_mm, posterior_rim_mm;
  std::optional<Vec3> trigonum_mm;        ///< TS, the root of the scapular spine at the medial border
  std::optional<Vec3> inferior_angle_mm;  ///< AI
  std::optional<HumeralHead> humeral_head;
  /// Of a biconcave glenoid, along one axial line: anterior edge of the paleoglenoid, ridge between both
  /// concavities, posterior edge of the neoglenoid. Three points or none.
  std::vector<Vec3> biconcavity_mm;
  std::string walch;  ///< A1, A2, B1, B2, B3, C1, C2 or D, picked by the user and never computed; "": none

  bool operator==(const Landmarks&) const = default;
};

/// landmarks.json (proto/landmarks.schema.json); any subset of the keys. `place` names the file in errors.
/// Error invalid_input names place and key (unknown keys, numbers that are not finite or beyond 100 m, a head
/// radius outside 5 to 60 mm, another count of biconcavity points than 3, unknown Walch class).
Landmarks landmarks_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json to_json(const Landmarks& landmarks);

/// landmarks.json of a case folder; written atomically, and nothing is written that could not be read again.
/// Errors: invalid_input, io. Loading gives nothing where there is no such file.
void save_landmarks(const Landmarks& landmarks, const std::filesystem::path& case_folder);
std::optional<Landmarks> load_landmarks(const std::filesystem::path& case_folder);

/// What a case says of the shoulder beside its bone: what directions and angles are measured against.
struct Anatomy {
  Side side = Side::right;
  std::optional<Landmarks> landmarks;
  std::optional<GlenoidFrame> glenoid;
};

/// Of a case and its folder. Errors: those of load_landmarks.
Anatomy anatomy_of(const Case& c, const std::filesystem::path& case_folder);

/// As recordings keep it. Error invalid_input names place and key.
Anatomy anatomy_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json to_json(const Anatomy& anatomy);

}  // namespace ream::case_
