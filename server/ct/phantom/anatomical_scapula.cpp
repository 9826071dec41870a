#include "ct/phantom/anatomical_scapula.hpp"

#include <Eigen/Geometry>
#include <limits>

namespace ream::ct {
namespace {

constexpr int parts_per_span = 4;

/// Catmull and Rom's curve through b and c; its ends are doubled.
template <typename Value>
Value spline(const Value& a, const Value& b, const Value& c, const Value& d, double t) {
  return b + 0.5 * t * ((c - a) + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

using Point = std::array<double, 2>;

double squared_distance(const Point& p, const Point& a, const Point& b) {
  const double abx = b[0] - a[0], aby = b[1] - a[1], x = p[0] - a[0], y = p[1] - a[1];
  const double t = std::clamp((x * abx + y * aby) / (abx * abx + aby * aby), 0.0, 1.0);
  const double dx = x - t * abx, dy = y - t * aby;
  return dx * dx + dy * dy;
}

// The body's outline in the scapular plane (lateral, superior), drawn inside by `corner_mm`: superior angle,
// root of the spine, medial border, inferior angle, lateral border up to the neck, superior border.
constexpr double corner_mm = 5.0;
constexpr Point outline[] = {{-88, 35},   {-97, 18},  {-100, 1},  {-99.5, -35}, {-96.5, -70}, {-91.5, -96},
                             {-87, -103}, {-82, -98}, {-72, -83}, {-58, -61},   {-42, -40},   {-20, -17},
                             {-20, 18},   {-40, 19},  {-62, 22},  {-77, 28}};
constexpr size_t corners = std::size(outline);
constexpr size_t first_lateral = 6, last_lateral = 11;  // corners of the lateral border
constexpr size_t first_medial = 0, last_medial = 5;

// Half thickness of the body: its middle, and what the borders add (51 cadavers: middle third 2.06 mm,
// lateral border 13.8, medial 4.4; Clin Should Elbow 15, 2012).
constexpr double thin_mm = 1.1, lateral_mm = 4.6, lateral_reach_mm = 7.0, medial_mm = 0.9,
                 medial_reach_mm = 6.0;
constexpr double bow_reach_mm = 15.0, rim_mm = 2.5;
// The bow begins medial of the neck, which is straight.
constexpr double bow_at_mm[] = {50.0, 85.0}, bow_share[] = {0.0, 1.0};

/// Distances in the plane: to the outline (negative within), and to the lines of its lateral and medial
/// border.
struct InOutline {
  double edge_mm, lateral_mm, medial_mm;
};

InOutline in_outline(const Point& p) {
  double edge = std::numeric_limits<double>::max(), lateral = edge, medial = edge;
  bool inside = false;
  for (size_t i = 0; i < corners; ++i) {
    const Point &a = outline[i], &b = outline[(i + 1) % corners];
    const double d = squared_distance(p, a, b);
    edge = std::min(edge, d);
    if (i >= first_lateral && i < last_lateral) lateral = std::min(lateral, d);
    if (i >= first_medial && i < last_medial) medial = std::min(medial, d);
    if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      inside = !inside;
  }
  const double to_edge = std::sqrt(edge);
  return {(inside ? -to_edge : to_edge) - corner_mm, std::sqrt(lateral), std::sqrt(medial)};
}

/// Falls from `most` at the border to a half at `reach`.
double falling(double most, double distance, double reach) {
  const double share = distance / reach;
  return most / (1.0 + share * share);
}

/// In the mean scapula's mm, and more than a joint takes away.
double far_of_sweep_mm(const AnatomicalSizes& s) {
  return AnatomicalScapula::far_mm / s.scale + joint_rounding_mm;
}

FlatSweep acromion_of(const AnatomicalSizes& s) {
  const auto at = [&](double x, double y, double z, double share) -> Vec3 {
    return {x + share * s.acromion_lateral_mm, y + share * s.acromion_superior_mm, z};
  };
  return FlatSweep({{at(5, 24.3, 32, 0.1), 5.5},
                    {at(11, 29, 31, 0.6), 9.5},
                    {at(19, 34, 22, 1.0), 11.5},
                    {at(20.5, 36.5, 11, 1.0), 12.0},
                    {at(21.5, 37.3, 4, 1.0), 10.0},
                    {at(22, 37.5, 0.5, 1.0), 6.5}},
                   {0.05, 0.97, 0.23}, 2.9, far_of_sweep_mm(s));
}

/// The crest of the spine, which overhangs its plate above and below.
FlatSweep crest_of_spine(const AnatomicalSizes& s) {
  return FlatSweep({{{-100, 0.4, 3.0}, 3.5},
                    {{-85, 2.4, 7}, 6.0},
                    {{-64, 5.3, 11.5}, 7.0},
                    {{-45, 8, 14.5}, 5.5},
                    {{-34, 9.5, 17}, 4.0}},
                   {-0.2, 0.0, 1.0}, 1.8, far_of_sweep_mm(s));
}

FlatSweep coracoid_of(const AnatomicalSizes& s) {
  const auto at = [&](double x, double y, double z, double share) -> Vec3 {
    return {x + share * s.coracoid_lateral_mm, y, z - share * s.coracoid_anterior_mm};
  };
  return FlatSweep({{at(-10, 32, -14, 0.0), 6.0},
                    {at(-5, 33, -21, 0.3), 7.3},
                    {at(3, 30.5, -27, 0.7), 7.3},
                    {at(11.5, 25.5, -30.5, 1.0), 5.6}},
                   {0.33, 0.90, -0.25}, 1.85, far_of_sweep_mm(s));
}

double triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, normal = ab.cross(-ca);
  const bool above = normal.cross(ab).dot(p - a) >= 0 && normal.cross(bc).dot(p - b) >= 0 &&
                     normal.cross(ca).dot(p - c) >= 0;
  if (above) return std::abs(normal.dot(p - a)) / normal.norm();
  return std::min({capsule(p, a, b, 0, 0), capsule(p, b, c, 0, 0), capsule(p, c, a, 0, 0)});
}

}  // namespace

FlatSweep::FlatSweep(const std::vector<Knot>& knots, const Vec3& flat, double flatness, double far_mm)
    : flat_(flat.normalized()), flatness_(flatness), far_mm_(far_mm) {
  Vec3 low = knots.front().at, high = low;
  double broadest = 0.0;
  for (const Knot& knot : knots) {
    low = low.cwiseMin(knot.at);
    high = high.cwiseMax(knot.at);
    broadest = std::max(broadest, knot.half_breadth_mm);
  }
  centre_ = 0.5 * (low + high);
  radius_mm_ = 0.5 * (high - low).norm() + broadest + 1.0;
  std::vector<Vec3> points;
  std::vector<double> radii;
  const auto knot = [&](size_t i) -> const Knot& { return knots[std::min(i, knots.size() - 1)]; };
  for (size_t i = 0; i + 1 < knots.size(); ++i)
    for (int part = 0; part < parts_per_span; ++part) {
      const double t = static_cast<double>(part) / parts_per_span;
      const Knot &a = knot(i == 0 ? 0 : i - 1), &b = knot(i), &c = knot(i + 1), &d = knot(i + 2);
      points.push_back(stretched(spline<Vec3>(a.at, b.at, c.at, d.at, t)));
      radii.push_back(
          spline<double>(a.half_breadth_mm, b.half_breadth_mm, c.half_breadth_mm, d.half_breadth_mm, t));
    }
  points.push_back(stretched(knots.back().at));
  radii.push_back(knots.back().half_breadth_mm);
  constexpr double slack = 1e-6;  // more than rounding
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const Capsule capsule(points[i], points[i + 1], radii[i], radii[i + 1]);
    const double reach = 0.5 * capsule.along.norm() + std::max(radii[i], radii[i + 1]) + slack;
    segments_.push_back({capsule, capsule.from + 0.5 * capsule.along, reach});
  }
}

double FlatSweep::value(const Vec3& p) const {
  // Across the plate the value grows by only 1 / flatness of the distance.
  const double at_least = ((p - centre_).norm() - radius_mm_) / flatness_;
  if (at_least > far_mm_) return at_least;
  const Vec3 at = stretched(p);
  const Segment* likely = &segments_.front();
  double squared_to_middle = std::numeric_limits<double>::max();
  for (const Segment& segment : segments_) {
    const double squared = (at - segment.middle).squaredNorm();
    if (squared < squared_to_middle) likely = &segment, squared_to_middle = squared;
  }
  double nearest = likely->capsule.value(at);
  for (const Segment& segment : segments_) {
    const double in_reach = nearest + segment.reach;
    if (in_reach <= 0.0 || (at - segment.middle).squaredNorm() > in_reach * in_reach) continue;
    nearest = std::min(nearest, segment.capsule.value(at));
  }
  return nearest / flatness_;
}

ProcessBases process_bases(const Vec3& p) {
  const Vec3 notch(-14.0, 12.0, 20.0);
  const Vec3 neck_top(-28.0, 10.0, 2.0), spine_start(-103.0, 0.0, 1.0);
  double spine = triangle_distance(p, spine_start, neck_top, notch) - 1.6;
  spine = rounded_min(spine, capsule(p, spine_start, notch, 2.5, 4.5), joint_rounding_mm);
  const Vec3 coracoid_base(-16.0, 15.0, -2.0);
  return {spine, capsule(p, notch, acromion_corner, 4.5, 5.5),
          capsule(p, coracoid_base, coracoid_bend, coracoid_radius_mm, coracoid_radius_mm)};
}

AnatomicalScapula::AnatomicalScapula(const AnatomicalSizes& sizes)
    : sizes_(sizes),
      crest_(crest_of_spine(sizes)),
      acromion_(acromion_of(sizes)),
      coracoid_(coracoid_of(sizes)) {}

double AnatomicalScapula::body_value(const Vec3& p) const {
  const Vec3 mean = p / sizes_.scale;
  const InOutline in = in_outline({mean.x(), mean.y()});
  const double within = std::max(0.0, -in.edge_mm);
  const double middle =
      sizes_.body_bow_mm * eased(bow_at_mm, bow_share, -mean.x()) * within / (within + bow_reach_mm);
  const double half_thickness = thin_mm + falling(lateral_mm, in.lateral_mm, lateral_reach_mm) +
                                falling(medial_mm, in.medial_mm, medial_reach_mm);
  return sizes_.scale * rounded_max(std::abs(mean.z() - middle) - half_thickness, in.edge_mm, rim_mm);
}

double AnatomicalScapula::body_share(double depth_mm) {
  constexpr double at[] = {44.0, 62.0}, share[] = {0.0, 1.0};
  return eased(at, share, depth_mm);
}

double AnatomicalScapula::processes_value(const Vec3& p) const {
  const Vec3 mean = p / sizes_.scale;
  const ProcessBases bases = process_bases(mean);
  double d = rounded_min(bases.spine, bases.acromion, joint_rounding_mm);
  d = rounded_min(d, crest_.value(mean), joint_rounding_mm);
  d = rounded_min(d, acromion_.value(mean), joint_rounding_mm);
  // The knuckle is round: the first quarter of the simple phantom's hook.
  constexpr double knuckle_share = 0.25;
  const Vec3 knuckle_end = coracoid_bend + knuckle_share * (coracoid_tip - coracoid_bend);
  const double knuckle_radius_mm =
      coracoid_radius_mm + knuckle_share * (coracoid_tip_radius_mm - coracoid_radius_mm);
  const double knuckle = capsule(mean, coracoid_bend, knuckle_end, coracoid_radius_mm, knuckle_radius_mm);
  const double coracoid = std::min(coracoid_.value(mean), knuckle);
  return sizes_.scale * std::min(d, rounded_min(bases.coracoid, coracoid, joint_rounding_mm));
}

}  // namespace ream::ct
