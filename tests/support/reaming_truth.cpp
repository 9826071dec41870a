#include "support/reaming_truth.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/units.hpp"

namespace ream::test {
namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();
constexpr double step_mm = 0.15;       // of the lattice that is integrated over
constexpr double reamed_mm = 0.05;     // from which on a place counts as reamed
constexpr double inside_rim_mm = 1.0;  // where the reamed face is looked at
constexpr double edge_mm = 0.25;       // of the face that does not count
constexpr double backing_mm = 0.5;     // of body behind the outermost cutting point

/// One tick of the trace that matters.
struct TracedPose {
  Vec3 apex_mm;
  Mat3 rotation;
  double removed_mm3 = 0.0;  ///< so far
};

std::vector<TracedPose> read_trace(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  const auto column = [&](const char* name) {
    return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const size_t x = column("tool_x_mm"), q = column("tool_qw"), volume = column("removed_volume_mm3");
  std::vector<TracedPose> poses;
  std::vector<double> row(names.size());
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (double& number : row) {
      std::getline(cells, cell, ',');
      number = std::stod(cell);
    }
    TracedPose pose;
    pose.apex_mm = Vec3(row[x], row[x + 1], row[x + 2]);
    pose.rotation = Eigen::Quaterniond(row[q], row[q + 1], row[q + 2], row[q + 3]).toRotationMatrix();
    pose.removed_mm3 = row[volume];
    poses.push_back(pose);
  }
  return poses;
}

struct Interval {
  double from = -nothing, to = nothing;
  bool empty() const { return from >= to; }
  void meet(const Interval& other) {
    from = std::max(from, other.from);
    to = std::min(to, other.to);
  }
};

/// Where a s^2 + 2 b s + c <= 0.
Interval below_zero(double a, double b, double c) {
  if (a < 1e-14) return c <= 0.0 ? Interval{} : Interval{0.0, 0.0};
  const double root2 = b * b - a * c;
  if (root2 <= 0.0) return {0.0, 0.0};
  return {(-b - std::sqrt(root2)) / a, (-b + std::sqrt(root2)) / a};
}

Interval half_space(double at_zero, double slope) {
  if (std::abs(slope) < 1e-14) return at_zero <= 0.0 ? Interval{} : Interval{0.0, 0.0};
  const double root = -at_zero / slope;
  return slope > 0.0 ? Interval{-nothing, root} : Interval{root, nothing};
}

/// Of a line within the reamer, tool frame.
Interval within(const ReamerShape& r, const Vec3& p, const Vec3& d) {
  const double a2 = r.across_mm * r.across_mm, b2 = r.along_mm * r.along_mm, z = p.z() + r.along_mm;
  Interval in = below_zero((d.x() * d.x() + d.y() * d.y()) / a2 + d.z() * d.z() / b2,
                           (p.x() * d.x() + p.y() * d.y()) / a2 + z * d.z() / b2,
                           (p.x() * p.x() + p.y() * p.y()) / a2 + z * z / b2 - 1.0);
  in.meet(below_zero(d.x() * d.x() + d.y() * d.y(), p.x() * d.x() + p.y() * d.y(),
                     p.x() * p.x() + p.y() * p.y() - r.outer_mm * r.outer_mm));
  in.meet(half_space(-r.behind_mm(r.outer_mm) - backing_mm - p.z(), -d.z()));
  if (r.nipple_mm > 0.0) in.meet(half_space(p.z() + r.behind_mm(r.nipple_mm), d.z()));
  return in;
}

/// Far intersection of a line with a sphere; nothing when it misses.
double on_sphere(const Vec3& centre, double radius_mm, const Vec3& p, const Vec3& d) {
  const Vec3 offset = p - centre;
  const Interval inside = below_zero(1.0, offset.dot(d), offset.squaredNorm() - radius_mm * radius_mm);
  return inside.empty() ? nothing : inside.to;
}

/// One line through the glenoid, mm along it.
struct Line {
  Vec3 point, direction;
  double x = 0.0, y = 0.0;      ///< place in its lattice
  double beyond_wall_mm = 0.0;  ///< of the place where it meets the face
  double face = nothing;        ///< the untouched face; nothing where the line misses it
  double gone = 0.0;            ///< length of bone that is gone
  double removed = 0.0;         ///< the same with what is left of a wall that leans over it
  double after = nothing;       ///< the face that is left; nothing where no bone is left of what was there
};

class Reamed {
 public:
  Reamed(const PlannedReaming& planned, const std::vector<TracedPose>& trace)
      : planned_(planned), glenoid_(planned.glenoid) {
    const double before = trace.front().removed_mm3;
    Vec3 last = Vec3::Constant(nothing);
    for (size_t i = 1; i < trace.size(); ++i) {
      const bool cuts = trace[i].removed_mm3 > std::max(before, trace[i - 1].removed_mm3);
      const bool deepest_yet = cuts && (trace[i].apex_mm - last).norm() > 0.002;
      const bool next_idle = i + 1 < trace.size() && !(trace[i + 1].removed_mm3 > trace[i].removed_mm3);
      if (!deepest_yet && !(cuts && next_idle)) continue;
      poses_.push_back(trace[i]);
      last = trace[i].apex_mm;
    }
  }
  const GlenoidFormulas& glenoid() const { return glenoid_; }

  /// Everything about a line; `direction` into the bone, `point` at about the depth of the face.
  void look_along(Line& line) const {
    const double sphere = face_depth(line.point, line.direction);
    if (sphere == nothing) return;
    const auto at = [&](double s) -> Vec3 { return line.point + s * line.direction; };
    line.beyond_wall_mm = glenoid_.beyond_wall_mm(at(sphere));
    if (line.beyond_wall_mm < 0.0) line.face = sphere;
    line.after = line.face;
    const std::vector<Interval> swept = swept_along(line, sphere);
    if (swept.empty()) return;
    Interval all{sphere, sphere};
    for (const Interval& one : swept) all.to = std::max(all.to, one.to);
    const bool on_bone = line.face != nothing && glenoid_.solid(at(all.to));
    const auto bone_in = [&](const Interval& stretch) {
      return on_bone ? stretch.to - stretch.from : crossed_bone(line, stretch);
    };
    for (const Interval& one : swept) line.gone += bone_in(one);
    line.removed = bone_in(all);
    line.after = on_bone ? all.to : nothing;
  }

  /// Depth along a line at which it comes to the sphere of the face, and to the plate's underside.
  double face_depth(const Vec3& p, const Vec3& d) const {
    return on_sphere(glenoid_.sphere_centre(), planned_.glenoid.radius_mm, p, d);
  }
  double plate_depth(const Vec3& p, const Vec3& d) const {
    return on_sphere(glenoid_.sphere_centre(), planned_.glenoid.radius_mm + planned_.glenoid.plate_mm, p, d);
  }

 private:
  /// What the reamer swept of a line from a depth on: stretches that do not touch, in any order.
  std::vector<Interval> swept_along(const Line& line, double from) const {
    std::vector<Interval> swept;
    for (const TracedPose& pose : poses_) {
      Interval in = within(planned_.reamer, pose.rotation.transpose() * (line.point - pose.apex_mm),
                           pose.rotation.transpose() * line.direction);
      in.from = std::max(in.from, from);
      if (in.empty()) continue;
      for (size_t i = 0; i < swept.size();) {
        if (swept[i].from > in.to || swept[i].to < in.from) {
          ++i;
          continue;
        }
        in = {std::min(in.from, swept[i].from), std::max(in.to, swept[i].to)};
        swept[i] = swept.back();
        swept.pop_back();
      }
      swept.push_back(in);
    }
    return swept;
  }

  /// Near the wall: length of bone within a stretch.
  double crossed_bone(const Line& line, const Interval& stretch) const {
    constexpr double stride = 0.05;
    const auto solid = [&](double s) { return glenoid_.solid(line.point + s * line.direction); };
    const auto edge = [&](double outside, double inside) {
      for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (outside + inside);
        (solid(middle) ? inside : outside) = middle;
      }
      return 0.5 * (outside + inside);
    };
    double length = 0.0;
    bool inside = false;
    double entered = stretch.from;
    for (double s = stretch.from + 1e-9; s < stretch.to; s += stride) {
      const bool now = solid(s);
      if (now && !inside) entered = s < stretch.from + stride ? stretch.from : edge(s - stride, s);
      if (!now && inside) length += edge(s, s - stride) - entered;
      inside = now;
    }
    if (inside) length += (solid(stretch.to) ? stretch.to : edge(stretch.to, stretch.to - stride)) - entered;
    return length;
  }

  PlannedReaming planned_;
  GlenoidFormulas glenoid_;
  std::vector<TracedPose> poses_;
};

/// Lines along a direction over a disc about an axis.
std::vector<Line> lattice(const Vec3& origin, const Vec3& direction, double reach_mm,
                          double spacing_mm = step_mm) {
  const Mat3 turn = rotation_with_z_along(direction);
  std::vector<Line> lines;
  const int half = static_cast<int>(reach_mm / spacing_mm);
  for (int row = -half; row <= half; ++row)
    for (int column = -half; column <= half; ++column) {
      Line line;
      line.x = (column + 0.37) * spacing_mm, line.y = (row - 0.21) * spacing_mm;
      if (std::hypot(line.x, line.y) > reach_mm) continue;
      line.point = origin + line.x * turn.col(0) + line.y * turn.col(1);
      line.direction = turn.col(2);
      lines.push_back(line);
    }
  return lines;
}

/// Mean axis and place of the apex over the last half millimetre along the plan, weighted by what was
/// removed.
Line achieved_line(const std::vector<TracedPose>& trace, const Vec3& along) {
  double deepest = -nothing;
  for (size_t i = 1; i < trace.size(); ++i)
    if (trace[i].removed_mm3 > trace[i - 1].removed_mm3)
      deepest = std::max(deepest, trace[i].apex_mm.dot(along));
  Vec3 axis = Vec3::Zero(), apex = Vec3::Zero();
  double weights = 0.0;
  for (size_t i = 1; i < trace.size(); ++i) {
    const double weight = trace[i].removed_mm3 - trace[i - 1].removed_mm3;
    if (!(weight > 0.0) || trace[i].apex_mm.dot(along) < deepest - 0.5) continue;
    axis += weight * trace[i].rotation.col(2);
    apex += weight * trace[i].apex_mm;
    weights += weight;
  }
  return {apex / weights, axis.normalized()};
}

double away_from(const Line& axis, const Vec3& p) { return (p - axis.point).cross(axis.direction).norm(); }

/// Face of the lines that count: not beside the pilot hole.
bool counts(const PlannedReaming& planned, const Line& line) {
  if (line.face == nothing || line.beyond_wall_mm > -edge_mm) return false;
  if (!planned.plan.pilot_hole) return true;
  const Line plan{planned.plan.entry_mm, planned.plan.axis_direction};
  return away_from(plan, line.point + line.face * line.direction) >=
         0.5 * planned.plan.pilot_hole->diameter_mm + planned.pilot_margin_mm;
}

void along_the_plan(const PlannedReaming& planned, const Reamed& reamed, const Line& achieved,
                    std::vector<Line>& lines, ReamingTruth& truth) {
  const double area = step_mm * step_mm;
  double sum = 0.0, whole = 0.0, preserved = 0.0;
  for (Line& line : lines) {
    const bool in_hole =
        planned.plan.pilot_hole && std::hypot(line.x, line.y) < 0.5 * planned.plan.pilot_hole->diameter_mm;
    if (!in_hole) truth.volume_mm3 += line.gone * area;
    if (!counts(planned, line)) continue;
    if (line.removed >= reamed_mm) {
      truth.footprint_mm2 += area;
      sum += line.removed * area;
      if (line.after != nothing) truth.depth_max_mm = std::max(truth.depth_max_mm, line.removed);
    }
    const double at = line.after != nothing ? line.after : line.face;
    if (away_from(achieved, line.point + at * line.direction) > planned.reamer.component_mm()) continue;
    const double plate = reamed.plate_depth(line.point, line.direction) - line.face;
    whole += area;
    if (line.removed <= 0.5 * plate) preserved += area;
  }
  truth.depth_mean_mm = truth.footprint_mm2 > 0.0 ? sum / truth.footprint_mm2 : 0.0;
  truth.plate_percent = 100.0 * preserved / whole;
}

/// How well and where a component stands.
struct Seat {
  double percent = 0.0;
  SeatedTruth where;
};

/// Seated along the achieved axis until 1 % of the area with bone sinks in.
Seat seat_of(const PlannedReaming& planned, const Reamed& reamed, const Line& achieved) {
  const double implant = planned.plan.implant_radius_mm.value_or(0.0);
  const auto behind = [&](double r) {
    return implant > 0.0 ? implant - std::sqrt(implant * implant - r * r) : planned.reamer.behind_mm(r);
  };
  std::vector<std::pair<double, double>> gaps;  // bone beyond the back, cosine of its slope
  size_t whole = 0;
  for (Line& line : lattice(achieved.point, achieved.direction, planned.reamer.component_mm())) {
    reamed.look_along(line);
    if (!counts(planned, line)) continue;
    ++whole;
    if (line.after == nothing) continue;
    const double r = std::hypot(line.x, line.y), h = 1e-4;
    const double slope = (behind(r + h * (r < h ? 1 : 0)) - behind(std::max(0.0, r - h))) / h;
    gaps.emplace_back(line.after + behind(r), 1.0 / std::hypot(1.0, slope));
  }
  std::sort(gaps.begin(), gaps.end());
  const double seat = gaps.at(static_cast<size_t>(0.01 * static_cast<double>(gaps.size()))).first;
  const auto supported = std::count_if(gaps.begin(), gaps.end(),
                                       [&](const auto& g) { return (g.first - seat) * g.second <= 0.5; });
  return {100.0 * static_cast<double>(supported) / static_cast<double>(whole),
          {achieved.point + seat * achieved.direction, achieved.direction}};
}

/// Places of the reamed face on the lattice of ReamedPlace.
std::vector<ReamedPlace> reamed_places(const PlannedReaming& planned, const Reamed& reamed) {
  const Vec3 along = planned.plan.axis_direction;
  const Vec3 up = (Vec3::UnitZ() - along.z() * along).normalized(), across = along.cross(up);
  const int most = static_cast<int>((planned.reamer.outer_mm + 4.0) / reamed_place_spacing_mm);
  std::vector<ReamedPlace> places;
  for (int column = -most; column <= most; ++column)
    for (int row = -most; row <= most; ++row) {
      Line line{planned.plan.entry_mm + reamed_place_spacing_mm * (column * across + row * up), along};
      reamed.look_along(line);
      if (!counts(planned, line) || line.removed < reamed_mm || line.after == nothing) continue;
      places.push_back({column, row, line.point + line.after * along});
    }
  return places;
}

/// Outermost reamed places at equal angles about the middle of the footprint, and the plane through them.
void fit_rim(const PlannedReaming& planned, const Reamed& reamed, const std::vector<Line>& lines,
             ReamingTruth& truth) {
  Vec3 middle = Vec3::Zero();
  double count = 0.0;
  const auto is_reamed = [&](const Line& line) {
    return counts(planned, line) && line.removed >= reamed_mm && line.after != nothing;
  };
  for (const Line& line : lines)
    if (is_reamed(line)) middle += line.point, count += 1.0;
  middle /= count;
  const Vec3 along = lines.front().direction;
  const Mat3 turn = rotation_with_z_along(along);
  std::vector<Vec3> points;
  for (int i = 0; i < 180; ++i) {
    const double angle = 2.0 * pi * i / 180.0;
    const Vec3 out = std::cos(angle) * turn.col(0) + std::sin(angle) * turn.col(1);
    double last = 0.0;
    const auto reamed_at = [&](double r) {
      Line line;
      line.point = middle + r * out;
      line.direction = along;
      reamed.look_along(line);
      if (is_reamed(line)) {
        last = r;
        return true;
      }
      return false;
    };
    for (double r = planned.reamer.outer_mm + 4.0; r > 0.0; r -= 0.2)
      if (reamed_at(r)) break;
    double beyond = last + 0.2;
    for (int halving = 0; halving < 12; ++halving) {
      const double r = 0.5 * (last + beyond);
      if (!reamed_at(r)) beyond = r;
    }
    Line inside;
    inside.point = middle + (last - inside_rim_mm) * out;
    inside.direction = along;
    reamed.look_along(inside);
    if (is_reamed(inside)) points.emplace_back(inside.point + inside.after * along);
  }
  // Depth along the plan's axis over the plane across it, by Huber's loss with 0.25 mm: Newton's steps on the
  // loss itself, each no longer than lowers it.
  Eigen::MatrixXd over(points.size(), 3);
  Eigen::VectorXd depth(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = turn.transpose() * (points[i] - middle);
    over.row(static_cast<Eigen::Index>(i)) << p.x(), p.y(), 1.0;
    depth[static_cast<Eigen::Index>(i)] = p.z();
  }
  const auto loss = [&](const Vec3& plane) {
    return (depth - over * plane)
        .unaryExpr([](double r) { return std::abs(r) <= 0.25 ? 0.5 * r * r : 0.25 * (std::abs(r) - 0.125); })
        .sum();
  };
  Vec3 plane = over.colPivHouseholderQr().solve(depth);
  for (int newton = 0; newton < 200; ++newton) {
    const Eigen::VectorXd left = depth - over * plane;
    const Eigen::VectorXd pull = left.cwiseMax(-0.25).cwiseMin(0.25);
    const Eigen::VectorXd bends = (left.array().abs() <= 0.25).cast<double>();
    const Mat3 curvature = over.transpose() * bends.asDiagonal() * over +
                           1e-6 * static_cast<double>(points.size()) * Mat3::Identity();
    Vec3 step = curvature.ldlt().solve(over.transpose() * pull);
    while (step.norm() > 1e-12 && loss(plane + step) > loss(plane)) step *= 0.5;
    if (step.norm() < 1e-12) break;
    plane += step;
  }
  Vec3 axis = turn * Vec3(-plane.x(), -plane.y(), 1.0).normalized();
  if (axis.dot(along) < 0.0) axis = -axis;
  std::tie(truth.rim_version_deg, truth.rim_inclination_deg) = reamed.glenoid().angles_deg(axis);
}

}  // namespace

double ReamerShape::behind_mm(double radius_mm) const {
  const double x = std::clamp(std::max(radius_mm, nipple_mm) / across_mm, 0.0, 1.0);
  return along_mm * (1.0 - std::sqrt(1.0 - x * x));
}

std::string ReamerShape::words() const {
  std::ostringstream text;
  text.precision(17);
  if (across_mm == along_mm)
    text << "sphere " << across_mm << ',' << outer_mm;
  else
    text << "ellipse " << across_mm << ',' << along_mm;
  if (nipple_mm > 0.0) text << " nipple " << nipple_mm << ",8";
  return text.str();
}

struct DepthTruth::Lines {
  struct Gone {
    Line line;
    double to = 0.0;  ///< how far the reamer has swept it, from line.face on
  };
  PlannedReaming planned;
  GlenoidFormulas glenoid;
  std::vector<Gone> all;

  Interval within_bone(const Line& line, const Pose& world_from_tool) const {
    const Pose tool_from_world = world_from_tool.inverse();
    Interval in =
        within(planned.reamer, tool_from_world.point(line.point), tool_from_world.direction(line.direction));
    in.from = std::max(in.from, line.face);
    return in;
  }
};

DepthTruth::DepthTruth(const PlannedReaming& planned)
    : lines_(std::make_unique<Lines>(Lines{planned, GlenoidFormulas(planned.glenoid), {}})) {
  constexpr double spacing_mm = 0.25, around_mm = 4.0;
  for (Line& line : lattice(planned.plan.entry_mm, planned.plan.axis_direction,
                            planned.reamer.outer_mm + around_mm, spacing_mm)) {
    line.face =
        on_sphere(lines_->glenoid.sphere_centre(), planned.glenoid.radius_mm, line.point, line.direction);
    if (line.face == nothing) continue;
    line.beyond_wall_mm = lines_->glenoid.beyond_wall_mm(line.point + line.face * line.direction);
    if (counts(planned, line)) lines_->all.push_back({line, line.face});
  }
}

DepthTruth::~DepthTruth() = default;

void DepthTruth::cut_at(const Pose& world_from_tool) {
  for (Lines::Gone& gone : lines_->all) {
    const Interval in = lines_->within_bone(gone.line, world_from_tool);
    if (!in.empty()) gone.to = std::max(gone.to, in.to);
  }
}

bool DepthTruth::touches(const Pose& world_from_tool) const {
  return std::any_of(lines_->all.begin(), lines_->all.end(), [&](const Lines::Gone& gone) {
    return !lines_->within_bone(gone.line, world_from_tool).empty();
  });
}

double DepthTruth::depth_mm() const {
  double deepest = 0.0;
  for (const auto& [line, to] : lines_->all)
    if (to - line.face > deepest && lines_->glenoid.solid(line.point + to * line.direction))
      deepest = to - line.face;
  return deepest;
}

namespace {

/// A trace of one cut: down the plan's axis, to its depth past where the reamer touches the face first.
std::vector<TracedPose> plan_carried_out(const PlannedReaming& planned, const std::vector<Line>& lines) {
  double contact = nothing;
  for (const Line& line : lines) {
    const double radius = std::hypot(line.x, line.y);
    if (counts(planned, line) && radius <= planned.reamer.outer_mm)
      contact = std::min(contact, line.face + planned.reamer.behind_mm(radius));
  }
  TracedPose pose;
  pose.rotation = rotation_with_z_along(planned.plan.axis_direction);
  pose.apex_mm = planned.plan.entry_mm + (contact + planned.plan.depth_mm) * planned.plan.axis_direction;
  std::vector<TracedPose> trace(3, pose);
  trace[1].removed_mm3 = trace[2].removed_mm3 = 1.0;
  return trace;
}

void against_the_plan(const PlannedReaming& planned, const std::vector<Line>& lines, ReamingTruth& truth) {
  const Reamed ideal(planned, plan_carried_out(planned, lines));
  std::vector<Line> wanted = lines;
  for (Line& line : wanted) {
    line.gone = line.removed = 0.0;
    ideal.look_along(line);
  }
  double both = 0.0;
  const double area = step_mm * step_mm;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (!counts(planned, lines[i])) continue;
    both += area * std::min(lines[i].removed, wanted[i].removed);
    truth.planned_mm3 += area * wanted[i].removed;
    truth.overreamed_mm3 += area * std::max(0.0, lines[i].removed - wanted[i].removed);
    truth.underreamed_mm3 += area * std::max(0.0, wanted[i].removed - lines[i].removed);
  }
  truth.overlap_percent = 200.0 * both / (2.0 * both + truth.overreamed_mm3 + truth.underreamed_mm3);
  const Line axis{planned.plan.entry_mm, planned.plan.axis_direction};
  const Seat seat = seat_of(planned, ideal, axis);
  truth.seating_planned_percent = seat.percent;
  truth.seated_as_planned = seat.where;
  ReamingTruth carried_out;
  along_the_plan(planned, ideal, axis, wanted, carried_out);
  truth.plate_planned_percent = carried_out.plate_percent;
}

}  // namespace

ReamingTruth reaming_truth(const PlannedReaming& planned, const std::filesystem::path& trace_csv) {
  const std::vector<TracedPose> trace = read_trace(trace_csv);
  const Reamed reamed(planned, trace);
  const Vec3 along = planned.plan.axis_direction;
  const Line achieved = achieved_line(trace, along);
  ReamingTruth truth;
  std::tie(truth.version_deg, truth.inclination_deg) = reamed.glenoid().angles_deg(achieved.direction);
  truth.axis_error_deg =
      degrees_from_radians(std::atan2(achieved.direction.cross(along).norm(), achieved.direction.dot(along)));
  const auto entry = [&](const Vec3& point, const Vec3& direction) -> Vec3 {
    return point + reamed.face_depth(point, direction) * direction;
  };
  truth.entry_error_mm =
      (entry(achieved.point, achieved.direction) - entry(planned.plan.entry_mm, along)).norm();
  std::vector<Line> lines = lattice(planned.plan.entry_mm, along, planned.reamer.outer_mm + 4.0);
  for (Line& line : lines) reamed.look_along(line);
  along_the_plan(planned, reamed, achieved, lines, truth);
  const Seat seat = seat_of(planned, reamed, achieved);
  truth.seating_percent = seat.percent;
  truth.seated = seat.where;
  truth.reamed = reamed_places(planned, reamed);
  fit_rim(planned, reamed, lines, truth);
  against_the_plan(planned, lines, truth);
  return truth;
}

}  // namespace ream::test
