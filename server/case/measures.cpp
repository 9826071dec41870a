#include "case/measures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/units.hpp"

namespace ream::case_ {
using nlohmann::json;
FaceAngles ScapularFrame::angles_of(const Vec3& face_normal) const {
  const double lateral_part = face_normal.dot(lateral);
  return {-std::atan2(face_normal.dot(posterior), lateral_part),
          std::atan2(face_normal.dot(superior), lateral_part)};
}

Vec3 ScapularFrame::face_normal(const FaceAngles& angles) const {
  return (lateral + std::tan(angles.inclination_rad) * superior - std::tan(angles.version_rad) * posterior)
      .normalized();
}

ScapularFrame scapular_frame(const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                             const Vec3& inferior_angle_mm) {
  ScapularFrame frame;
  frame.lateral = (glenoid_centre_mm - spine_root_mm).normalized();
  frame.posterior = (spine_root_mm - glenoid_centre_mm).cross(inferior_angle_mm - glenoid_centre_mm);
  if (!(frame.posterior.norm() > 1e-9))
    throw Error(ErrorKind::invalid_input, "spine root, inferior angle and glenoid centre lie on one line");
  frame.posterior.normalize();
  if (frame.posterior.y() < 0.0) frame.posterior = -frame.posterior;
  frame.superior = frame.posterior.cross(frame.lateral);
  if (frame.superior.dot(glenoid_centre_mm - inferior_angle_mm) < 0.0) frame.superior = -frame.superior;
  return frame;
}

FaceAngles face_angles(const Vec3& face_normal, const Vec3& glenoid_centre_mm, const Vec3& spine_root_mm,
                       const Vec3& inferior_angle_mm) {
  return scapular_frame(glenoid_centre_mm, spine_root_mm, inferior_angle_mm).angles_of(face_normal);
}

namespace {

constexpr double min_distance_mm = 0.1;  // landmarks nearer to each other than this are a slip

/// The two ends of the rim lines.
struct RimLines {
  Vec3 superior, inferior, anterior, posterior;
};

[[noreturn]] void contradiction(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "landmarks: " + what);
}

/// The anterior-posterior line's ends: of a biconcave glenoid those of its intermediate line.
std::optional<Vec3> anterior_end(const Landmarks& l) {
  return l.biconcavity_mm.size() == 3 ? l.biconcavity_mm.front() : l.anterior_rim_mm;
}
std::optional<Vec3> posterior_end(const Landmarks& l) {
  return l.biconcavity_mm.size() == 3 ? l.biconcavity_mm.back() : l.posterior_rim_mm;
}

/// Towards the patient's side as far as the landmarks can tell: away from the trigonum, else along LPS x.
Vec3 outward(const Landmarks& l, Side side) {
  if (l.glenoid_centre_mm && l.trigonum_mm) return *l.glenoid_centre_mm - *l.trigonum_mm;
  return side == Side::left ? Vec3::UnitX() : Vec3(-Vec3::UnitX());
}

/// Unit normal of the plane along both rim lines, lateral: in a right shoulder anterior x superior, in a left
/// one the other way about.
Vec3 face_normal(const Vec3& superior_line, const Vec3& anterior_line, Side side, const Vec3& towards) {
  Vec3 normal = anterior_line.cross(superior_line);
  if (!(normal.norm() > 1e-3 * anterior_line.norm() * superior_line.norm()))
    contradiction("the rim points lie on one line; place superior and inferior, anterior and posterior anew");
  if (side == Side::left) normal = -normal;
  if (!(normal.dot(towards) > 0.0))
    contradiction("the rim points belong to the other shoulder than the " + to_text(side) +
                  " one, or two of them (superior and inferior, anterior and posterior) are swapped");
  return normal.normalized();
}

void check_apart(const Vec3& a, const Vec3& b, const char* what) {
  if (!((a - b).norm() > min_distance_mm)) contradiction(std::string(what) + " are the same point");
}

std::optional<RimLines> rim_lines(const Landmarks& l) {
  const auto anterior = anterior_end(l), posterior = posterior_end(l);
  if (!l.superior_rim_mm || !l.inferior_rim_mm || !anterior || !posterior) return std::nullopt;
  check_apart(*l.superior_rim_mm, *l.inferior_rim_mm, "superior and inferior rim");
  check_apart(*anterior, *posterior, "anterior and posterior rim");
  return RimLines{*l.superior_rim_mm, *l.inferior_rim_mm, *anterior, *posterior};
}

std::optional<ScapularFrame> frame_of(const Landmarks& l, Side side) {
  if (!l.glenoid_centre_mm || !l.trigonum_mm || !l.inferior_angle_mm) return std::nullopt;
  const Vec3 to_spine = *l.trigonum_mm - *l.glenoid_centre_mm,
             to_angle = *l.inferior_angle_mm - *l.glenoid_centre_mm;
  check_apart(*l.trigonum_mm, *l.glenoid_centre_mm, "trigonum and glenoid centre");
  if (!(to_spine.cross(to_angle).norm() > 1e-3 * to_spine.norm() * to_angle.norm()))
    contradiction("trigonum, inferior angle and glenoid centre lie on one line; place them anew");
  const ScapularFrame frame = scapular_frame(*l.glenoid_centre_mm, *l.trigonum_mm, *l.inferior_angle_mm);
  const double handedness = frame.lateral.cross(frame.superior).dot(frame.posterior);
  if ((handedness > 0.0) != (side == Side::right))
    contradiction("trigonum, inferior angle and glenoid centre are those of the other shoulder than the " +
                  to_text(side) + " one");
  return frame;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Angle at the middle of the line a-b from `from` to b, less a right angle (delta, gamma - 90).
double tilt_at_middle(const Vec3& from, const Vec3& a, const Vec3& b) {
  const Vec3 middle = 0.5 * (a + b);
  check_apart(from, middle, "trigonum and the middle of the rim");
  return angle_between(from - middle, b - middle) - 0.5 * pi;
}

double friedman_version(const Landmarks& l, const Vec3& anterior, const Vec3& posterior) {
  const auto axial = [](const Vec3& p) -> Vec3 { return {p.x(), p.y(), 0.0}; };
  check_apart(axial(anterior), axial(posterior), "anterior and posterior rim");
  return tilt_at_middle(axial(*l.trigonum_mm), axial(anterior), axial(posterior));
}

double friedman_inclination(const Landmarks& l) {
  const Vec3 middle = 0.5 * (*l.superior_rim_mm + *l.inferior_rim_mm);
  Vec3 along = middle - *l.trigonum_mm;
  along.z() = 0.0;
  if (!(along.norm() > min_distance_mm))
    contradiction("the trigonum lies right above or below the glenoid; place it anew");
  along.normalize();
  const auto coronal = [&](const Vec3& p) -> Vec3 { return {along.dot(p), p.z(), 0.0}; };
  check_apart(coronal(*l.superior_rim_mm), coronal(*l.inferior_rim_mm), "superior and inferior rim");
  return tilt_at_middle(coronal(*l.trigonum_mm), coronal(*l.superior_rim_mm), coronal(*l.inferior_rim_mm));
}

double share_posterior(const HumeralHead& head, const Vec3& origin, const Vec3& posterior) {
  return std::clamp(50.0 + 50.0 * (head.centre_mm - origin).dot(posterior) / head.radius_mm, 0.0, 100.0);
}

Biconcavity biconcavity_of(const Landmarks& l, const ScapularFrame& frame, Side side) {
  const Vec3 superior = *l.superior_rim_mm - *l.inferior_rim_mm;
  const Vec3 &front = l.biconcavity_mm[0], &ridge = l.biconcavity_mm[1], &back = l.biconcavity_mm[2];
  check_apart(front, ridge, "paleoglenoid's edge and ridge of the biconcavity");
  check_apart(ridge, back, "ridge and neoglenoid's edge of the biconcavity");
  const auto normal_of = [&](const Vec3& line) { return face_normal(superior, line, side, frame.lateral); };
  const Vec3 paleo = normal_of(front - ridge), neo = normal_of(ridge - back);
  return {frame.angles_of(paleo).version_rad, frame.angles_of(neo).version_rad,
          frame.angles_of(normal_of(front - back)).version_rad, angle_between(paleo, neo)};
}

/// Landmarks that some measure misses, each once, in the order of the file.
std::vector<std::string> missing_of(const Landmarks& l) {
  std::vector<std::string> missing;
  const auto need = [&](bool there, const char* key) {
    if (!there) missing.emplace_back(key);
  };
  need(l.glenoid_centre_mm.has_value(), "glenoid_centre_mm");
  need(l.superior_rim_mm.has_value(), "superior_rim_mm");
  need(l.inferior_rim_mm.has_value(), "inferior_rim_mm");
  need(anterior_end(l).has_value(), "anterior_rim_mm");
  need(posterior_end(l).has_value(), "posterior_rim_mm");
  need(l.trigonum_mm.has_value(), "trigonum_mm");
  need(l.inferior_angle_mm.has_value(), "inferior_angle_mm");
  need(l.humeral_head.has_value(), "humeral_head");
  return missing;
}

}  // namespace

Measures measure(const Landmarks& l, Side side) {
  Measures m;
  m.missing = missing_of(l);
  const auto frame = frame_of(l, side);
  const auto rim = rim_lines(l);
  const auto anterior = anterior_end(l), posterior = posterior_end(l);
  if (frame && rim) {
    const Vec3 normal =
        face_normal(rim->superior - rim->inferior, rim->anterior - rim->posterior, side, outward(l, side));
    const FaceAngles angles = frame->angles_of(normal);
    m.version_3d_rad = angles.version_rad;
    m.inclination_3d_rad = angles.inclination_rad;
    if (l.biconcavity_mm.size() == 3) m.biconcavity = biconcavity_of(l, *frame, side);
  }
  if (l.trigonum_mm && anterior && posterior)
    m.version_friedman_rad = friedman_version(l, *anterior, *posterior);
  if (l.trigonum_mm && l.superior_rim_mm && l.inferior_rim_mm)
    m.inclination_friedman_rad = friedman_inclination(l);
  if (!l.humeral_head) return m;
  if (frame) m.subluxation_percent = share_posterior(*l.humeral_head, *l.glenoid_centre_mm, frame->posterior);
  if (l.glenoid_centre_mm && anterior && posterior) {
    check_apart(*anterior, *posterior, "anterior and posterior rim");
    m.subluxation_glenoid_percent =
        share_posterior(*l.humeral_head, *l.glenoid_centre_mm, (*posterior - *anterior).normalized());
  }
  return m;
}

GlenoidFrame glenoid_frame(const Landmarks& l, Side side) {
  const auto rim = rim_lines(l);
  if (!rim || !l.glenoid_centre_mm) {
    std::string names;
    for (const std::string& key : missing_of(l))
      if (key == "glenoid_centre_mm" || key.ends_with("_rim_mm")) names += (names.empty() ? "" : ", ") + key;
    contradiction(names + " missing; the glenoid's frame needs its centre and the four rim points");
  }
  GlenoidFrame frame;
  const Vec3 superior = rim->superior - rim->inferior;
  frame.centre_mm = *l.glenoid_centre_mm;
  frame.lateral = face_normal(superior, rim->anterior - rim->posterior, side, outward(l, side));
  frame.superior = (superior - superior.dot(frame.lateral) * frame.lateral).normalized();
  frame.anterior = frame.superior.cross(frame.lateral);
  if (frame.anterior.dot(rim->anterior - rim->posterior) < 0.0) frame.anterior = -frame.anterior;
  return frame;
}

namespace {

/// Healthy shoulders; low and high are the range that was seen, or of what counts as centred.
json normal_values() {
  return {{"version_deg",
           {{"mean", -1.23}, {"low", -10.5}, {"high", 9.5}, {"source", "Churchill 2001, 344 scapulae"}}},
          {"inclination_deg",
           {{"mean", 4.2}, {"low", -7.0}, {"high", 15.8}, {"source", "Churchill 2001, 344 scapulae"}}},
          {"subluxation_percent",
           {{"mean", 50.0}, {"low", 45.0}, {"high", 55.0}, {"source", "Walch 1999: 45 to 55 is centred"}}}};
}

std::string in_words(double rad, const char* negative, const char* positive, const char* none) {
  const double tenths = std::floor(std::abs(degrees_from_radians(rad)) * 10.0 + 0.5);
  char number[32];
  std::snprintf(number, sizeof number, "%.1f", tenths / 10.0);
  return std::string(number) + "\u00b0 " + (tenths == 0.0 ? none : rad < 0.0 ? negative : positive);
}

}  // namespace

json degrees_or_null(const std::optional<double>& rad) {
  return rad ? json(degrees_from_radians(*rad)) : json(nullptr);
}

std::string version_in_words(double version_rad) {
  return in_words(version_rad, "retroversion", "anteversion", "version");
}

std::string inclination_in_words(double inclination_rad) {
  return in_words(inclination_rad, "inferior", "superior", "inclination");
}

json to_json(const Measures& m) {
  json value = {{"version_3d_deg", degrees_or_null(m.version_3d_rad)},
                {"inclination_3d_deg", degrees_or_null(m.inclination_3d_rad)},
                {"version_friedman_deg", degrees_or_null(m.version_friedman_rad)},
                {"inclination_trigonum_deg", degrees_or_null(m.inclination_friedman_rad)},
                // The name that it had in the version before.
                {"inclination_friedman_deg", degrees_or_null(m.inclination_friedman_rad)},
                {"subluxation_percent", or_null(m.subluxation_percent)},
                {"subluxation_glenoid_percent", or_null(m.subluxation_glenoid_percent)},
                {"biconcavity", nullptr},
                {"normal", normal_values()},
                {"missing", m.missing},
                {"words", {{"version", nullptr}, {"inclination", nullptr}}}};
  if (const auto& b = m.biconcavity)
    value["biconcavity"] = {{"paleo_version_deg", degrees_from_radians(b->paleo_version_rad)},
                            {"neo_version_deg", degrees_from_radians(b->neo_version_rad)},
                            {"intermediate_version_deg", degrees_from_radians(b->intermediate_version_rad)},
                            {"between_deg", degrees_from_radians(b->between_rad)}};
  if (m.version_3d_rad) value["words"]["version"] = version_in_words(*m.version_3d_rad);
  if (m.inclination_3d_rad) value["words"]["inclination"] = inclination_in_words(*m.inclination_3d_rad);
  return value;
}

}  // namespace ream::case_
