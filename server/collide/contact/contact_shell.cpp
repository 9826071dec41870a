#include "collide/contact/contact_shell.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/units.hpp"

namespace ream::collide {
namespace {

constexpr double unit_code = 127.0;

int coded(double value) { return static_cast<int>(std::lround(value * unit_code)); }

/// A point of the shell on its way into the contact shell.
struct Probe {
  Vec3 place_mm;
  int normal_radial, normal_z, arm, weight, area;
  uint32_t azimuth, normal;
  bool guiding;
};

/// One length below the surface; where the surface faces along the axis, also two lengths nearer to it.
Vec3 guiding_probe(const Vec3& surface_mm, const Vec3& normal, double length_mm) {
  const double radius_mm = std::hypot(surface_mm.x(), surface_mm.y());
  const double inwards_mm = std::min(radius_mm, 2.0 * length_mm * std::abs(normal.z()));
  const Vec3 radial = radius_mm > 0.0 ? Vec3(surface_mm.x() / radius_mm, surface_mm.y() / radius_mm, 0.0)
                                      : Vec3(Vec3::Zero());
  return surface_mm - length_mm * normal - inwards_mm * radial;
}

uint32_t packed_normal(const Vec3& normal) {
  uint32_t packed = 0;
  for (int i = 0; i < 3; ++i) packed |= (static_cast<uint32_t>(coded(normal[i])) & 0xff) << (8 * i);
  return packed;
}

/// Room between a probe and the rim, voxels: the centre of the voxel that a point is judged by lies this
/// near.
constexpr double rim_room_voxels = 0.75;
/// Where the surface turns into the tool's side there is no rim: |normal z| below this.
constexpr double min_rim_slope = 0.35;

/// On the cutting surface, along its meridian away from a rim of radius `rim_mm` that is nearer than
/// `room_mm`.
Vec3 inside_rim(const Vec3& surface_mm, const Vec3& normal, double rim_mm, double room_mm) {
  const double radius_mm = std::hypot(surface_mm.x(), surface_mm.y());
  const double missing_mm = room_mm - (rim_mm - radius_mm);
  if (missing_mm <= 0.0 || normal.z() < min_rim_slope || radius_mm <= room_mm) return surface_mm;
  const Vec3 radial(surface_mm.x() / radius_mm, surface_mm.y() / radius_mm, 0.0);
  const Vec3 inwards = -normal.z() * radial + normal.dot(radial) * Vec3::UnitZ();
  return surface_mm + std::min(missing_mm / normal.z(), room_mm / min_rim_slope) * inwards;
}

/// What all probes of a shell are made with.
struct ProbeRule {
  double length_mm, moment_length_mm, rim_mm;
  ContactRule contact;

  Vec3 place_mm(const Vec3& surface_mm, const Vec3& normal, bool guiding) const {
    if (guiding) return guiding_probe(surface_mm, normal, length_mm);
    if (contact == ContactRule::one_voxel_out) return surface_mm + length_mm * normal;
    return inside_rim(surface_mm, normal, rim_mm, rim_room_voxels * length_mm);
  }
};

Probe probe_of(const shell::PointShell& shell, const shell::ShellPoint& p, const ProbeRule& rule) {
  const Vec3 normal = p.normal.cast<double>(), surface = shell.surface_point_mm(p);
  const double radius_mm = std::hypot(surface.x(), surface.y());
  const double angle = radius_mm > 0.0 ? std::atan2(surface.y(), surface.x()) : 0.0;
  const double radial = normal.x() * std::cos(angle) + normal.y() * std::sin(angle);
  Probe probe{};
  probe.guiding = p.role != shell::SurfaceRole::cutting;
  probe.place_mm = rule.place_mm(surface, normal, probe.guiding);
  if (!probe.guiding && rule.contact == ContactRule::at_surface) probe.normal = packed_normal(normal);
  probe.normal_radial = coded(radial);
  probe.normal_z = coded(normal.z());
  probe.arm = coded((radius_mm * normal.z() - surface.z() * radial) / rule.moment_length_mm);
  probe.weight = probe.area = p.area_weight;
  probe.azimuth = static_cast<uint32_t>(std::lround(angle / (2.0 * pi) * azimuth_count)) % azimuth_count;
  return probe;
}

constexpr int max_weight = 255;

/// Weighs cutting probes by their edge; what is more than a weight holds is added as further probes without
/// area. No edge is nearer to the axis than half a cell, `min_radius_mm`.
void weigh_edges(const shell::PointShell& shell, double min_radius_mm, std::vector<Probe>& probes) {
  const size_t count = probes.size();
  for (size_t i = 0; i < count; ++i) {
    if (probes[i].guiding) continue;
    const Vec3 surface_mm = shell.surface_point_mm(shell.points[i]);
    const double radius_mm = std::max(min_radius_mm, std::hypot(surface_mm.x(), surface_mm.y()));
    int left = std::max(1, static_cast<int>(std::lround(probes[i].area * edge_radius_mm / radius_mm)));
    probes[i].weight = std::min(left, max_weight);
    for (left -= max_weight; left > 0; left -= max_weight) {
      Probe further = probes[i];
      further.weight = std::min(left, max_weight);
      further.area = 0;
      probes.push_back(further);
    }
  }
}

/// Numbers the distinct meridian entries; should there be too many, they are told apart less finely.
class MeridianEntries {
 public:
  explicit MeridianEntries(const std::vector<Probe>& probes) {
    for (step_ = 1; collect(probes) > max_meridian_entries; step_ *= 2) {
    }
  }
  uint32_t number(const Probe& p) const { return numbers_.at(key(p)); }
  DirectionTable table() const {
    DirectionTable table{std::vector<uint32_t>(numbers_.size()), std::vector<uint32_t>(numbers_.size()),
                         azimuth_table()};
    for (const auto& [k, number] : numbers_) {
      const auto [radial, axial, arm, weight, area] = k;
      table.meridian[number] = meridian_entry(radial, axial, arm, weight);
      table.areas[number] = static_cast<uint32_t>(area);
    }
    return table;
  }

 private:
  using Key = std::tuple<int, int, int, int, int>;
  Key key(const Probe& p) const {
    const auto stepped = [this](int v) {
      return std::clamp((v + (v < 0 ? -1 : 1) * (step_ / 2)) / step_ * step_, -127, 127);
    };
    return {stepped(p.normal_radial), stepped(p.normal_z), stepped(p.arm), p.weight, p.area};
  }
  size_t collect(const std::vector<Probe>& probes) {
    numbers_.clear();
    for (const Probe& p : probes) numbers_.try_emplace(key(p), 0u);
    uint32_t next = 0;
    for (auto& [k, number] : numbers_) number = next++;
    return numbers_.size();
  }

  int step_ = 1;
  std::map<Key, uint32_t> numbers_;
};

/// Runs of probes that become one block each: those of a shell block, cutting apart from guiding.
struct Run {
  size_t first, count;
};

/// Small blocks side by side (of the same 16^3 cells) go together until they have so many points.
constexpr size_t enough_points = 96;
constexpr int parent_bits = 12;

bool go_together(const shell::PointShell& shell, const shell::ShellBlock& a, const shell::ShellBlock& b) {
  return shell.points[a.first].morton >> parent_bits == shell.points[b.first].morton >> parent_bits;
}

std::vector<Run> sorted_into_runs(const shell::PointShell& shell, std::vector<Probe>& probes) {
  std::vector<Run> runs;
  for (size_t b = 0, end = 0; b < shell.blocks.size(); b = end) {
    const size_t first = shell.blocks[b].first;
    size_t count = 0;
    for (end = b; end < shell.blocks.size() && go_together(shell, shell.blocks[b], shell.blocks[end]);
         ++end) {
      if (count > 0 && (count >= enough_points || count + shell.blocks[end].count > max_block_points)) break;
      count += shell.blocks[end].count;
    }
    const auto begin = probes.begin() + static_cast<std::ptrdiff_t>(first);
    const auto middle = std::stable_partition(begin, begin + static_cast<std::ptrdiff_t>(count),
                                              [](const Probe& p) { return !p.guiding; });
    const auto cutting = static_cast<size_t>(middle - begin);
    if (cutting > 0) runs.push_back({first, cutting});
    if (cutting < count) runs.push_back({first + cutting, count - cutting});
  }
  return runs;
}

Aabb box_of(const std::vector<Probe>& probes, const Run& run) {
  Aabb box;
  for (size_t i = run.first; i < run.first + run.count; ++i) box.include(probes[i].place_mm);
  return box;
}

void add_block(const std::vector<Probe>& probes, const Run& run, const MeridianEntries& entries,
               ContactShell& out) {
  const Aabb box = box_of(probes, run);
  ContactBlock block;
  block.first = static_cast<uint32_t>(run.first);
  block.count = static_cast<uint16_t>(run.count);
  block.guiding = probes[run.first].guiding;
  block.origin_units = (box.min / out.place_unit_mm).array().floor().cast<int>();
  const Vec3 centre = box.centre();
  double radius_mm = 0.0;
  for (size_t i = run.first; i < run.first + run.count; ++i) {
    const Probe& p = probes[i];
    const Vec3i place =
        (p.place_mm / out.place_unit_mm).array().round().cast<int>().matrix() - block.origin_units;
    const uint32_t direction = entries.number(p) << azimuth_bits | p.azimuth;
    out.places[i] = static_cast<uint32_t>(place.x()) | static_cast<uint32_t>(place.y()) << place_bits |
                    static_cast<uint32_t>(place.z()) << (2 * place_bits) | (direction >> 16) << 27;
    out.directions[i] = static_cast<uint16_t>(direction);
    out.normals[i] = p.normal | static_cast<uint32_t>(p.weight) << 24;
    add_products(out.table.vector(direction), block.whole);
    block.height_units = std::max(block.height_units, place.z());
    radius_mm = std::max(radius_mm, (out.probe_mm(block, i) - centre).norm());
  }
  out.blocks.push_back(block);
  out.first_chunks.push_back(out.first_chunks.back() +
                             static_cast<uint32_t>((run.count + chunk_points - 1) / chunk_points));
  out.centre_x_mm.push_back(static_cast<float>(centre.x()));
  out.centre_y_mm.push_back(static_cast<float>(centre.y()));
  out.centre_z_mm.push_back(static_cast<float>(centre.z()));
  out.radius_mm.push_back(static_cast<float>(radius_mm + out.place_unit_mm));
  out.bounds_mm.include(box.min);
  out.bounds_mm.include(box.max);
}

}  // namespace

Vec3 ContactShell::probe_mm(const ContactBlock& block, size_t point) const {
  const uint32_t p = places[point];
  const Vec3i place(static_cast<int>(p & place_mask), static_cast<int>(p >> place_bits & place_mask),
                    static_cast<int>(p >> (2 * place_bits) & place_mask));
  return place_unit_mm * (block.origin_units + place).cast<double>();
}

size_t ContactShell::bytes() const {
  return (places.size() + normals.size()) * sizeof(uint32_t) + directions.size() * sizeof(uint16_t) +
         blocks.size() * (sizeof(ContactBlock) + sizeof(uint32_t) + 4 * sizeof(float)) +
         (2 * table.meridian.size() + table.azimuth.size()) * sizeof(uint32_t);
}

ContactShell make_contact_shell(const shell::PointShell& shell, double probe_length_mm, ContactRule rule) {
  ContactShell out;
  out.probe_length_mm = probe_length_mm;
  out.cell_area_mm2 = shell.spacing_mm * shell.spacing_mm;
  double longest = 0.0, rim_mm = 0.0;
  for (const auto& p : shell.points) {
    const Vec3 surface_mm = shell.surface_point_mm(p);
    longest = std::max(longest, surface_mm.norm());
    if (p.role == shell::SurfaceRole::cutting)
      rim_mm = std::max(rim_mm, std::hypot(surface_mm.x(), surface_mm.y()));
  }
  out.moment_length_mm = std::max(longest, 1.0);

  std::vector<Probe> probes;
  probes.reserve(shell.points.size());
  const ProbeRule probe_rule{probe_length_mm, out.moment_length_mm, rim_mm, rule};
  for (const auto& p : shell.points) probes.push_back(probe_of(shell, p, probe_rule));
  weigh_edges(shell, 0.5 * shell.spacing_mm, probes);
  std::vector<Run> runs = sorted_into_runs(shell, probes);
  for (size_t i = shell.points.size(); i < probes.size(); i += max_block_points)
    runs.push_back({i, std::min<size_t>(max_block_points, probes.size() - i)});
  const MeridianEntries entries(probes);
  out.table = entries.table();

  double extent_mm = 0.0;
  for (const Run& run : runs)
    extent_mm = std::max(extent_mm, 2.0 * box_of(probes, run).half_size().maxCoeff());
  // Rounding the origin down and a place to nearest takes up to two units more.
  out.place_unit_mm = std::max(extent_mm, shell.spacing_mm) / (place_mask - 2);
  out.first_chunks = {0};
  out.places.resize(probes.size() + chunk_points);
  out.directions.resize(probes.size() + chunk_points);
  out.normals.resize(probes.size() + chunk_points);
  for (const Run& run : runs) add_block(probes, run, entries, out);
  return out;
}

std::vector<uint32_t> azimuth_table() {
  std::vector<uint32_t> table(azimuth_count);
  for (uint32_t i = 0; i < azimuth_count; ++i) {
    const double angle = 2.0 * pi * i / azimuth_count;
    const auto coded = [](double x) {
      return static_cast<uint32_t>(std::lround(x * (1 << azimuth_shift))) & 0xffff;
    };
    table[i] = coded(std::cos(angle)) | coded(std::sin(angle)) << 16;
  }
  return table;
}

void add_products(const ContactVector& v, ContactProducts& sums) noexcept {
  size_t k = 0;
  for (size_t i = 0; i < 5; ++i)
    for (size_t j = i; j < 5; ++j) sums[k++] += v.weight * v.g[i] * v.g[j];
  for (size_t i = 0; i < 5; ++i) sums[k++] += v.weight * v.g[i];
  sums[k++] += v.weight * v.cosine;
  sums[k++] += v.weight * v.sine;
  sums[k++] += v.weight;
  sums[k] += v.area;
}

}  // namespace ream::collide
