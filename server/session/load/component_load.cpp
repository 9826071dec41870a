#include "session/load/component_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "report/deviation_scale.hpp"
#include "score/alignment.hpp"
#include "score/deviation.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_coverages.hpp"
#include "session/simulation/recorded_session.hpp"
#include "sim/model.hpp"
#include "solve/element_strains.hpp"

namespace ream::session {
namespace {

/// Effective strain that Pistoia 2002 takes for a sign of failure, of elements much smaller than these: here
/// a mark for comparison.
constexpr double yield_strain = 0.007;
constexpr double near_mm = 3.0, peak_share = 0.99;
/// Of the way from the component's middle to its rim.
constexpr double off_middle = 0.5;
/// Bone so full of it counts as such where strain is looked at.
constexpr float solid_share = 0.5f;

struct Direction {
  const char* name;
  Vec3 in_lattice;
};

/// As session_pictures() has them.
std::array<Direction, 5> directions_of(const score::NativeGlenoid& native) {
  const auto& glenoid = native.task().anatomy.glenoid;
  const auto across = [&](const Vec3& world) {
    Vec3 d = native.rays().lattice_direction(world);
    d.z() = 0.0;
    return d.norm() > 1e-6 ? Vec3(d.normalized()) : Vec3(Vec3::UnitX());
  };
  const Vec3 superior = across(glenoid ? glenoid->superior : Vec3(Vec3::UnitZ()));
  const Vec3 front = across(glenoid ? glenoid->anterior : Vec3(-Vec3::UnitY()));
  Vec3 anterior(superior.y(), -superior.x(), 0.0);
  if (anterior.dot(front) < 0.0) anterior = -anterior;
  return {{{"centre", Vec3::Zero()},
           {"anterior", anterior},
           {"posterior", -anterior},
           {"superior", superior},
           {"inferior", -superior}}};
}

/// How far the component reaches from its middle in a direction across.
double rim_mm(const score::Component& component, const std::vector<uint8_t>& under, const SeatBox& box,
              const Vec3& direction) {
  double reach_mm = 0.0;
  for (int y = 0; y < box.dims.y(); ++y)
    for (int x = 0; x < box.dims.x(); ++x) {
      if (under[box.index(x, y, 0)] == 0) continue;
      Vec3 across = box.middle_mm(x, y, 0) - component.apex_mm();
      across.z() = 0.0;
      const double along = across.dot(direction);
      if ((across - along * direction).norm() <= box.cell_mm) reach_mm = std::max(reach_mm, along);
    }
  return reach_mm;
}

/// Which cells of bone are looked at.
struct Watched {
  std::vector<size_t> plate, near;
};

Watched watched_cells(const score::NativeGlenoid& native, const SeatState& state, const SeatBox& box,
                      const solve::SeatedCells& cells) {
  Watched watched;
  const std::vector<uint8_t> under = footprint_of(native, state.component, box);
  for (int y = 0; y < box.dims.y(); ++y)
    for (int x = 0; x < box.dims.x(); ++x) {
      const Vec3 middle = box.middle_mm(x, y, 0);
      const int nearest = native.rays().nearest(middle.x(), middle.y());
      if (under[box.index(x, y, 0)] == 0 || nearest < 0 || is_over_pilot_hole(native, box, x, y)) continue;
      const auto ray = static_cast<size_t>(nearest);
      const double surface_mm = state.face.surface_mm[ray], top_mm = native.subchondral_mm()[ray];
      if (surface_mm == score::no_surface_mm) continue;
      for (int z = 0; z < box.dims.z(); ++z) {
        const size_t cell = box.index(x, y, z);
        const double depth_mm = box.middle_mm(x, y, z).z();
        if (cells.bone_share[cell] < solid_share || depth_mm < surface_mm) continue;
        if (depth_mm < surface_mm + near_mm) watched.near.push_back(cell);
        if (depth_mm >= top_mm && depth_mm < top_mm + native.plate().thickness_mm[ray])
          watched.plate.push_back(cell);
      }
    }
  return watched;
}

/// Those that have a strain: what was cleared to make room for the component has none.
std::vector<float> strains_of(const solve::SeatResponse& response, const std::vector<size_t>& cells) {
  std::vector<float> strains;
  for (const size_t cell : cells)
    if (response.effective_strain[cell] > 0.0f) strains.push_back(response.effective_strain[cell]);
  return strains;
}

std::optional<double> peak_of(const std::vector<float>& strains) {
  return strains.empty() ? std::nullopt : std::optional(solve::quantile(strains, peak_share));
}

/// `back`: columns of the component that bone could support.
LoadedSeat described(const char* name, const solve::SeatResponse& response, const Watched& watched,
                     double back) {
  LoadedSeat seat;
  seat.name = name;
  const auto carrying = std::count(response.carrying.begin(), response.carrying.end(), uint8_t{1});
  seat.carrying_percent = 100.0 * static_cast<double>(carrying) / back;
  std::vector<float> motion;  // what carries is squeezed, and neither lifts off nor slips
  for (size_t column = 0; column < response.motion_mm.size(); ++column)
    if (!std::isnan(response.motion_mm[column]))
      motion.push_back(response.carrying[column] != 0 ? 0.0f : response.motion_mm[column]);
  seat.motion_um = 1000.0 * solve::quantile(motion, peak_share);
  seat.sinking_um = 1000.0 * response.sinking_mm;
  const std::vector<float> near = strains_of(response, watched.near);
  seat.plate_strain = peak_of(strains_of(response, watched.plate));
  seat.bone_strain = peak_of(near);
  const auto above =
      std::count_if(near.begin(), near.end(), [](float strain) { return strain > yield_strain; });
  seat.overstrained_percent =
      near.empty() ? 0.0 : 100.0 * static_cast<double>(above) / static_cast<double>(near.size());
  seat.rounds = response.rounds;
  seat.iterations = response.iterations;
  seat.settled = response.settled && response.converged;
  return seat;
}

void add_to_map(const solve::SeatResponse& response, const Watched& watched, size_t columns,
                std::vector<float>& map) {
  for (const size_t cell : watched.near) {
    float& greatest = map[cell % columns];
    greatest = std::max(greatest, response.effective_strain[cell]);
  }
}

LoadedState loaded(const score::NativeGlenoid& native, const voxel::BoneModel& bone, const SeatState& state,
                   const SeatBox& box, const ComponentLoadRequest& request, ThreadPool& pool,
                   const Progress& progress) {
  LoadedState result;
  result.name = state.name;
  solve::SeatedCells cells = seat_cells(native, bone, state, box, request.law);
  const Watched watched = watched_cells(native, state, box, cells);
  const std::vector<uint8_t> under = footprint_of(native, state.component, box);
  double back = 0.0, supported = 0.0;
  for (int y = 0; y < box.dims.y(); ++y)
    for (int x = 0; x < box.dims.x(); ++x) {
      const size_t column = box.index(x, y, 0);
      back += under[column] != 0 && !is_over_pilot_hole(native, box, x, y);
      supported += cells.supported[column];
    }
  result.supported_percent = 100.0 * supported / back;
  result.strain_map.assign(box.columns(), 0.0f);
  const solve::SeatedComponent seated(std::move(cells), request.materials);
  result.elements = seated.elements();
  const auto directions = directions_of(native);
  const size_t loads = std::min(request.loads, directions.size());
  for (size_t i = 0; i < loads; ++i) {
    const Vec3 at =
        state.component.apex_mm() - box.corner_mm +
        off_middle * rim_mm(state.component, under, box, directions[i].in_lattice) * directions[i].in_lattice;
    const solve::SeatResponse response =
        seated.respond({at.x(), at.y(), 5.0, request.force_n}, request.limits, pool,
                       part_of(progress, static_cast<double>(i) / static_cast<double>(loads),
                               static_cast<double>(i + 1) / static_cast<double>(loads)));
    result.loads.push_back(described(directions[i].name, response, watched, back));
    add_to_map(response, watched, box.columns(), result.strain_map);
    if (result.supported_percent > 0.0)
      result.support_lost_percent =
          std::max(result.support_lost_percent,
                   100.0 - 100.0 * result.loads.back().carrying_percent / result.supported_percent);
  }
  return result;
}

nlohmann::json or_null(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace

double LoadedState::motion_um() const {
  double greatest = 0.0;
  for (const LoadedSeat& load : loads) greatest = std::max(greatest, load.motion_um);
  return greatest;
}

std::optional<double> LoadedState::plate_strain() const {
  std::optional<double> greatest;
  for (const LoadedSeat& load : loads)
    if (load.plate_strain) greatest = std::max(greatest.value_or(0.0), *load.plate_strain);
  return greatest;
}

double LoadedState::overstrained_percent() const {
  double greatest = 0.0;
  for (const LoadedSeat& load : loads) greatest = std::max(greatest, load.overstrained_percent);
  return greatest;
}

bool ComponentLoad::settled() const {
  return std::all_of(states.begin(), states.end(), [](const LoadedState& state) {
    return std::all_of(state.loads.begin(), state.loads.end(),
                       [](const LoadedSeat& load) { return load.settled; });
  });
}

ComponentLoad load_component(const score::NativeGlenoid& native, const voxel::BoneModel& bone,
                             const std::vector<SeatState>& states, const ComponentLoadRequest& request,
                             const Progress& progress) {
  if (states.empty())
    throw Error(ErrorKind::conflict,
                "no component can be seated: the case has no plan, or there is no bone under it");
  ComponentLoad load;
  load.request = request;
  load.box.emplace(native, states, request.cell_mm);
  ThreadPool pool(request.threads);
  for (size_t i = 0; i < states.size(); ++i) {
    const auto count = static_cast<double>(states.size());
    load.states.push_back(
        loaded(native, bone, states[i], *load.box, request, pool,
               part_of(progress, static_cast<double>(i) / count, static_cast<double>(i + 1) / count)));
  }
  return load;
}

RecordedLoad load_recorded(const record::Recording& recording, const std::string& case_name,
                           const std::filesystem::path& data, const ComponentLoadRequest& request,
                           const Progress& progress) {
  const score::MetricsAccumulator ticks = accumulated(recording, part_of(progress, 0.0, 0.05));
  case_::Case bone_case = recorded_case(recording, case_name, data);
  RecordedLoad recorded;
  recorded.native = recorded_glenoid(recording, bone_case, case_name, data);
  recorded.grid = bone_case.bone.grid;
  Coverages coverages = coverages_of(recording, bone_case);
  recorded.left = std::move(coverages.left);
  std::optional<score::CutLine> line = ticks.cut_line();
  if (line) line = score::in_lattice(recorded.native->rays(), *line, sim::world_from_plan(*bone_case.plan));
  recorded.load = load_component(
      *recorded.native, bone_case.bone,
      seat_states(*recorded.native, recorded.grid, coverages.start.data(), recorded.left.data(), line),
      request, part_of(progress, 0.1, 1.0));
  return recorded;
}

const LoadedState* ComponentLoad::state(std::string_view name) const {
  const auto found =
      std::find_if(states.begin(), states.end(), [&](const LoadedState& s) { return s.name == name; });
  return found == states.end() ? nullptr : &*found;
}

std::vector<int8_t> RecordedLoad::strain_codes(std::span<const Vec3f> vertices_mm) const {
  std::vector<int8_t> codes(vertices_mm.size(), score::deviation_unknown);
  const LoadedState* state = load.state("reamed");
  if (state == nullptr) return codes;
  const SeatBox& box = *load.box;
  for (size_t i = 0; i < codes.size(); ++i) {
    const Vec3 at = native->rays().in_lattice(grid.world_from_grid.point(vertices_mm[i].cast<double>()));
    const Vec3 cell = (at - box.corner_mm) / box.cell_mm;
    const int x = static_cast<int>(std::floor(cell.x())), y = static_cast<int>(std::floor(cell.y()));
    if (x < 0 || y < 0 || x >= box.dims.x() || y >= box.dims.y()) continue;
    const double strain = state->strain_map[box.index(x, y, 0)];
    if (strain > 0.0)
      codes[i] = static_cast<int8_t>(std::clamp(std::round(strain / report::strain_step), 0.0, 127.0));
  }
  const score::AchievedFace face = score::achieved_face(*native, {grid, left.data()});
  score::keep_face_only(*native, face, grid, vertices_mm, codes);
  return codes;
}

nlohmann::json to_json(const ComponentLoad& load) {
  nlohmann::json states = nlohmann::json::array();
  for (const LoadedState& state : load.states) {
    nlohmann::json loads = nlohmann::json::array();
    for (const LoadedSeat& seat : state.loads)
      loads.push_back({{"load", seat.name},
                       {"carrying_percent", seat.carrying_percent},
                       {"motion_um", seat.motion_um},
                       {"sinking_um", seat.sinking_um},
                       {"plate_strain", or_null(seat.plate_strain)},
                       {"bone_strain", or_null(seat.bone_strain)},
                       {"overstrained_percent", seat.overstrained_percent},
                       {"rounds", seat.rounds},
                       {"iterations", seat.iterations},
                       {"settled", seat.settled}});
    states.push_back({{"state", state.name},
                      {"elements", state.elements},
                      {"supported_percent", state.supported_percent},
                      {"support_lost_percent", state.support_lost_percent},
                      {"motion_um", state.motion_um()},
                      {"plate_strain", or_null(state.plate_strain())},
                      {"overstrained_percent", state.overstrained_percent()},
                      {"loads", std::move(loads)}});
  }
  return {{"force_n", load.request.force_n},
          {"cell_mm", load.request.cell_mm},
          {"law", load.request.law.description()},
          {"component_mpa", load.request.materials.component_mpa},
          {"cement_mpa", load.request.materials.cement_mpa},
          {"poisson", load.request.materials.poisson},
          {"settled", load.settled()},
          {"states", std::move(states)}};
}

}  // namespace ream::session
