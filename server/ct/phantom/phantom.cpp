#include "ct/phantom/phantom.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/thread_pool.hpp"
#include "core/units.hpp"
#include "ct/build/bone_from_mask.hpp"
#include "ct/phantom/phantom_shape.hpp"
#include "surface/block_mesh.hpp"

namespace ream::ct {
namespace {

constexpr double soft_tissue_hu = 50.0;
constexpr double cortical_g_cc = 1.5;
constexpr double sclerotic_g_cc = 1.1, sclerotic_mm = 4.0;  // under the plate of a face worn behind

/// What osteoporosis leaves: of the spongy bone, of the compact bone's density and of its thickness.
constexpr double porotic_spongy = 0.65, porotic_compact = 0.85, porotic_thickness = 0.7;
constexpr double max_field_voxels = 6.0e8;
constexpr int phantom_threads = 2;

struct TypeName {
  PhantomType type;
  const char* text;
};
constexpr TypeName type_names[] = {{PhantomType::a1, "A1"},
                                   {PhantomType::a2, "A2"},
                                   {PhantomType::b1, "B1"},
                                   {PhantomType::b2, "B2"},
                                   {PhantomType::b3, "B3"},
                                   {PhantomType::c1, "C1"},
                                   {PhantomType::d, "D"},
                                   {PhantomType::osteophytes, "osteophytes"},
                                   {PhantomType::osteoporotic, "osteoporotic"}};

void check(const PhantomParams& p) {
  const auto within = [](const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    const auto text = [](double v) { return nlohmann::json(v).dump(); };
    throw Error(ErrorKind::invalid_input, std::string("phantom: ") + what + " is " + text(value) +
                                              ", must be between " + text(low) + " and " + text(high));
  };
  within("version in degrees", degrees_from_radians(p.version_rad), -40.0, 40.0);
  within("inclination in degrees", degrees_from_radians(p.inclination_rad), -40.0, 40.0);
  within("glenoid radius in mm", p.glenoid_radius_mm, 25.0, 60.0);
  within("glenoid height in mm", p.glenoid_height_mm, 20.0, 48.0);
  within("glenoid width in mm", p.glenoid_width_mm, 12.0, 40.0);
  within("subchondral plate in mm", p.plate_mm, 0.0, 5.0);
  within("cortical shell in mm", p.shell_mm, 0.0, 5.0);
  within("joint space in mm", p.joint_space_mm, 1.0, 12.0);
  within("radius of the humeral head in mm", p.head_radius_mm, 15.0, 32.0);
  within("noise in HU", p.noise_hu, 0.0, 500.0);
  for (int axis = 0; axis < 3; ++axis) within("voxel size in mm", p.spacing_mm[axis], 0.05, 10.0);
}

/// Sum of four 16-bit uniforms of one hash, centred and scaled to standard deviation 1: near Gaussian, and
/// the same on every machine.
double noise(uint64_t seed, uint64_t index) {
  const uint64_t h = mix64(hash_combine(seed, index));
  const int64_t sum =
      static_cast<int64_t>((h & 0xffff) + ((h >> 16) & 0xffff) + ((h >> 32) & 0xffff) + (h >> 48));
  constexpr double four_uniforms_sd = 65536.0 * 0.57735026918962573;  // sqrt(4/12)
  return static_cast<double>(sum - 2 * 65535) / four_uniforms_sd;
}

/// Share of a voxel on the inner side of a border at signed distance `d` (negative inside).
double inside_share(double d, double voxel_mm) { return std::clamp(0.5 - d / voxel_mm, 0.0, 1.0); }

/// Apparent density of the trabecular bone: densest posterior and near the face.
double cancellous_g_cc(double posterior_mm, double depth_mm) {
  return std::clamp(0.56 + 0.010 * posterior_mm - 0.004 * std::max(0.0, depth_mm), 0.40, 0.70);
}

bool is_porotic(const PhantomParams& p) { return p.type == PhantomType::osteoporotic; }

/// With what osteoporosis leaves of plate and shell.
PhantomParams with_its_thickness(PhantomParams p) {
  if (!is_porotic(p)) return p;
  p.plate_mm *= porotic_thickness;
  p.shell_mm *= porotic_thickness;
  return p;
}

double compact_g_cc(const PhantomParams& p) {
  return is_porotic(p) ? porotic_compact * cortical_g_cc : cortical_g_cc;
}

/// Density of spongy bone that nothing has worn.
double sound_spongy_g_cc(const PhantomShape& shape, const PhantomParams& p, const Vec3& world,
                         double depth_mm) {
  const double healthy = cancellous_g_cc(shape.posterior_mm(world), depth_mm);
  return is_porotic(p) ? porotic_spongy * healthy : healthy;
}

/// Density of what is not compact at a point of a right shoulder's scapula.
double spongy_g_cc(const PhantomShape& shape, const PhantomParams& p, const Vec3& world, double depth_mm) {
  const double sound = sound_spongy_g_cc(shape, p, world, depth_mm);
  const double worn = p.type == PhantomType::b2 ? shape.depth_under_neoglenoid_mm(world) : depth_mm;
  const bool behind =
      p.type == PhantomType::b2 || (p.type == PhantomType::b3 && shape.is_behind_middle(world));
  const bool sclerotic = behind && worn < p.plate_mm + sclerotic_mm && worn == depth_mm;
  return sclerotic ? sclerotic_g_cc : sound;
}

/// HU without noise at a point of a right shoulder.
double tissue_hu(const PhantomShape& shape, const PhantomParams& p, const Vec3& world, double voxel_mm) {
  const double head = shape.humerus_mm(world), scapula = shape.scapula_mm(world);
  const double bone = std::min(head, scapula);
  const double filled = inside_share(bone, voxel_mm);
  if (filled == 0.0) return soft_tissue_hu;
  const double shell = inside_share(-(bone + p.shell_mm), voxel_mm);
  const double depth = shape.depth_under_face_mm(world);
  const bool in_scapula = scapula < head;
  const double plate = in_scapula && depth < p.plate_mm + voxel_mm && !shape.is_process(world)
                           ? inside_share(depth - p.plate_mm, voxel_mm)
                           : 0.0;
  const double compact = std::max(shell, plate);
  const double spongy =
      in_scapula ? spongy_g_cc(shape, p, world, depth) : sound_spongy_g_cc(shape, p, world, depth);
  const double density = compact * compact_g_cc(p) + (1.0 - compact) * spongy;
  return filled * hu_of_apparent_density(density, p.calibration) + (1.0 - filled) * soft_tissue_hu;
}

Vec3 mirrored(const Vec3& v) { return {-v.x(), v.y(), v.z()}; }

void mirror(GroundTruth& truth) {
  for (Vec3* v : {&truth.glenoid.centre_mm, &truth.glenoid.lateral, &truth.glenoid.superior,
                  &truth.glenoid.anterior, &truth.articular_sphere_centre_mm, &truth.spine_root_mm,
                  &truth.inferior_angle_mm, &truth.humeral_head_centre_mm})
    *v = mirrored(*v);
  case_::Landmarks& l = truth.landmarks;
  for (auto* point : {&l.glenoid_centre_mm, &l.superior_rim_mm, &l.inferior_rim_mm, &l.anterior_rim_mm,
                      &l.posterior_rim_mm, &l.trigonum_mm, &l.inferior_angle_mm})
    *point = mirrored(**point);
  l.humeral_head->centre_mm = mirrored(l.humeral_head->centre_mm);
  for (Vec3& point : l.biconcavity_mm) point = mirrored(point);
}

}  // namespace

std::string to_text(PhantomType type) {
  for (const TypeName& named : type_names)
    if (named.type == type) return named.text;
  return "A1";
}

PhantomType phantom_type_from_text(const std::string& text) {
  for (const TypeName& named : type_names)
    if (named.text == text) return named.type;
  std::string words;
  for (const std::string& each : phantom_type_texts()) words += (words.empty() ? "" : ", ") + each;
  throw Error(ErrorKind::invalid_input, "phantom type '" + text + "' must be one of " + words);
}

std::vector<std::string> phantom_type_texts() {
  std::vector<std::string> texts;
  for (const TypeName& named : type_names) texts.emplace_back(named.text);
  return texts;
}

std::string phantom_source(const PhantomParams& params) {
  return "phantom, random seed " + std::to_string(params.random_seed);
}

Phantom make_phantom(const PhantomParams& params) {
  check(params);
  const PhantomParams sized = with_its_thickness(params);
  const PhantomShape shape(sized);
  Phantom phantom{{}, shape.truth()};
  const bool left = params.side == case_::Side::left;
  HuVolume& volume = phantom.volume;
  const Vec3 voxels =
      ((params.field_mm.max - params.field_mm.min).array() / params.spacing_mm.array()).round().matrix();
  if (!(voxels.minCoeff() >= 1.0))
    throw Error(ErrorKind::invalid_input, "phantom: the field holds no voxels");
  if (voxels.prod() > max_field_voxels)
    throw Error(ErrorKind::invalid_input, "phantom: more than 6e8 voxels; choose a larger voxel size");
  volume.dims = voxels.cast<int>();
  volume.spacing_mm = params.spacing_mm;
  const Vec3 origin = phantom.truth.glenoid.centre_mm + params.field_mm.min;
  volume.world_from_volume.translation_mm = origin;
  volume.source = phantom_source(params);
  volume.hu.resize(volume.voxel_count());
  const double voxel_mm = params.spacing_mm.minCoeff();
  parallel_for(phantom_threads, static_cast<size_t>(volume.dims.z()), [&](size_t slice) {
    const int w = static_cast<int>(slice);
    for (int v = 0; v < volume.dims.y(); ++v)
      for (int u = 0; u < volume.dims.x(); ++u) {
        const double exact = tissue_hu(shape, sized, volume.world_of_centre({u, v, w}), voxel_mm) +
                             params.noise_hu * noise(params.random_seed, volume.index(u, v, w));
        const int column = left ? volume.dims.x() - 1 - u : u;
        volume.hu[volume.index(column, v, w)] =
            static_cast<int16_t>(std::clamp(std::floor(exact + 0.5), double{min_hu}, 3071.0));
      }
  });
  phantom.truth.side = params.side;
  if (left) {
    mirror(phantom.truth);
    volume.world_from_volume.translation_mm.x() = -(origin.x() + volume.dims.x() * volume.spacing_mm.x());
  }
  return phantom;
}

TriangleMesh scapula_surface(const PhantomParams& params, double sample_mm) {
  check(params);
  const PhantomParams p = with_its_thickness(params);
  const PhantomShape shape(p);
  const bool left = p.side == case_::Side::left;
  voxel::VoxelGrid grid;
  grid.spacing_mm = Vec3::Constant(sample_mm);
  grid.dims = voxel::whole_bricks(
      ((p.field_mm.max - p.field_mm.min) / sample_mm).array().ceil().cast<int>().matrix());
  Vec3 origin = shape.truth().glenoid.centre_mm + p.field_mm.min;
  if (left) origin.x() = -(origin.x() + grid.dims.x() * sample_mm);
  grid.world_from_grid.translation_mm = origin;
  // Over four samples: corners of the surface lie between two values that both still say how far it is. Then
  // they are put onto it.
  const double ramp_mm = 4.0 * sample_mm;
  std::vector<uint8_t> coverage(grid.voxel_count());
  parallel_for(phantom_threads, coverage.size() / voxel::brick_voxels, [&](size_t brick) {
    for (size_t i = brick * voxel::brick_voxels; i < (brick + 1) * voxel::brick_voxels; ++i) {
      const Vec3 world = grid.world_from_grid.point(grid.centre_mm(grid.coordinates(i)));
      const double inside = inside_share(shape.scapula_mm(left ? mirrored(world) : world), ramp_mm);
      coverage[i] = static_cast<uint8_t>(std::lround(255.0 * inside));
    }
  });
  TriangleMesh surface = surface::whole_surface(grid, coverage.data()).transformed(grid.world_from_grid);
  for (Vec3f& vertex : surface.vertices_mm) {
    const Vec3 world = vertex.cast<double>();
    const Vec3 exact = shape.on_scapula(left ? mirrored(world) : world);
    vertex = (left ? mirrored(exact) : exact).cast<float>();
  }
  return surface;
}

std::function<double(const Vec3&)> true_density_g_cc(const PhantomParams& params) {
  check(params);
  const PhantomParams p = with_its_thickness(params);
  return [p, shape = PhantomShape(p)](const Vec3& world_mm) {
    const Vec3 world = p.side == case_::Side::left ? mirrored(world_mm) : world_mm;
    const double scapula = shape.scapula_mm(world), depth = shape.depth_under_face_mm(world);
    if (scapula > 0.0) return 0.0;
    if (scapula > -p.shell_mm) return compact_g_cc(p);
    if (depth < p.plate_mm && !shape.is_process(world)) return compact_g_cc(p);
    return spongy_g_cc(shape, p, world, depth);
  };
}

nlohmann::json to_json(const GroundTruth& t) {
  const auto list = [](const Vec3& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  nlohmann::json value = {{"side", case_::to_text(t.side)},
                          {"type", to_text(t.type)},
                          {"version_deg", degrees_from_radians(t.version_rad)},
                          {"inclination_deg", degrees_from_radians(t.inclination_rad)},
                          {"glenoid",
                           {{"centre_mm", list(t.glenoid.centre_mm)},
                            {"lateral", list(t.glenoid.lateral)},
                            {"superior", list(t.glenoid.superior)},
                            {"anterior", list(t.glenoid.anterior)}}},
                          {"articular_sphere_centre_mm", list(t.articular_sphere_centre_mm)},
                          {"articular_radius_mm", t.articular_radius_mm},
                          {"glenoid_height_mm", t.glenoid_height_mm},
                          {"glenoid_width_mm", t.glenoid_width_mm},
                          {"plate_mm", t.plate_mm},
                          {"spine_root_mm", list(t.spine_root_mm)},
                          {"inferior_angle_mm", list(t.inferior_angle_mm)},
                          {"humeral_head_centre_mm", list(t.humeral_head_centre_mm)},
                          {"humeral_head_radius_mm", t.humeral_head_radius_mm},
                          {"landmarks", case_::to_json(t.landmarks)}};
  for (const auto& [key, version] :
       {std::pair{"premorbid_version_deg", t.premorbid_version_rad},
        std::pair{"paleo_version_deg", t.paleo_version_rad}, std::pair{"neo_version_deg", t.neo_version_rad}})
    if (version) value[key] = degrees_from_radians(*version);
  return value;
}

}  // namespace ream::ct
