#include "case/glenoid_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace ream::case_ {
namespace {

constexpr double unit_tolerance = 1e-6;

nlohmann::json list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec3(const std::vector<double>& n) { return {n[0], n[1], n[2]}; }

}  // namespace

GlenoidFrame glenoid_from_json(JsonReader reader) {
  GlenoidFrame frame;
  frame.centre_mm = vec3(reader.numbers("centre_mm", 3));
  for (const auto& [key, axis] :
       {std::pair{"lateral", &frame.lateral}, std::pair{"superior", &frame.superior},
        std::pair{"anterior", &frame.anterior}}) {
    *axis = vec3(reader.numbers(key, 3));
    if (!(std::abs(axis->norm() - 1.0) < unit_tolerance)) reader.refuse(key, "must be a unit vector");
  }
  reader.finish();
  return frame;
}

nlohmann::json to_json(const GlenoidFrame& frame) {
  return {{"centre_mm", list(frame.centre_mm)},
          {"lateral", list(frame.lateral)},
          {"superior", list(frame.superior)},
          {"anterior", list(frame.anterior)}};
}

}  // namespace ream::case_
