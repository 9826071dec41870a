#include "case/anatomy.hpp"

#include <nlohmann/json.hpp>

#include "case/glenoid_json.hpp"
#include "core/json_reader.hpp"

namespace ream::case_ {

Anatomy anatomy_of(const Case& c, const std::filesystem::path& case_folder) {
  return {c.side, load_landmarks(case_folder), c.glenoid};
}

Anatomy anatomy_from_json(const nlohmann::json& value, const std::string& place) {
  JsonReader reader(value, place);
  Anatomy anatomy;
  const std::string side = reader.text("side");
  if (side != "left" && side != "right") reader.refuse("side", "must be left or right");
  anatomy.side = side_from_text(side);
  if (reader.has("landmarks"))
    anatomy.landmarks = landmarks_from_json(value.at("landmarks"), place + ".landmarks");
  if (reader.has("glenoid")) anatomy.glenoid = glenoid_from_json(reader.object("glenoid"));
  reader.finish();
  return anatomy;
}

nlohmann::json to_json(const Anatomy& anatomy) {
  nlohmann::json value = {{"side", to_text(anatomy.side)}};
  if (anatomy.landmarks) value["landmarks"] = to_json(*anatomy.landmarks);
  if (anatomy.glenoid) value["glenoid"] = to_json(*anatomy.glenoid);
  return value;
}

}  // namespace ream::case_
