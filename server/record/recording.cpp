#include "record/recording.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/json.hpp"

namespace ream::record {
namespace {

using nlohmann::json;

uint32_t flags_of(const TickReport& r) {
  return (r.spindle_on ? spindle_on_flag : 0u) | (r.paused ? paused_flag : 0u) |
         (r.failed_over ? failed_over_flag : 0u) | (r.engaged ? engaged_flag : 0u) |
         (r.cutting ? cutting_flag : 0u) | (r.weakened ? weakened_flag : 0u) | (r.stale ? stale_flag : 0u) |
         (r.stalled ? stalled_flag : 0u) | drive_flags(r.drive);
}

/// Takes the ops it names; ops::read() passes over the others unread.
template <typename... Takers>
struct Taking : Takers... {
  using Takers::operator()...;
};
template <typename... Takers>
Taking(Takers...) -> Taking<Takers...>;

}  // namespace

uint32_t drive_flags(const device::DriveControls& drive) noexcept {
  return (drive.reversed ? reversed_flag : 0u) | (drive.irrigating ? irrigating_flag : 0u) |
         (255u - drive.trigger) << trigger_slack_shift;
}

device::DriveControls drive_of_flags(uint32_t flags) noexcept {
  return {static_cast<uint8_t>(255u - (flags >> trigger_slack_shift & 255u)), (flags & reversed_flag) != 0,
          (flags & irrigating_flag) != 0};
}

std::string grid_to_text(const voxel::VoxelGrid& grid) {
  const auto list = [](const auto& v) { return json{v.x(), v.y(), v.z()}; };
  json rotation = json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation.push_back(grid.world_from_grid.rotation(row, column));
  return json{{"dims", list(grid.dims)},
              {"spacing_mm", list(grid.spacing_mm)},
              {"world_from_grid",
               {{"rotation", rotation}, {"translation_mm", list(grid.world_from_grid.translation_mm)}}}}
      .dump();
}

voxel::VoxelGrid grid_from_text(const std::string& text) {
  try {
    const json grid = parse_json_or_discard(text);
    const auto vector = [](const json& list) {
      return Vec3(list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>());
    };
    voxel::VoxelGrid read;
    for (int axis = 0; axis < 3; ++axis)
      read.dims[axis] = grid.at("dims").at(static_cast<size_t>(axis)).get<int>();
    read.spacing_mm = vector(grid.at("spacing_mm"));
    const json& pose = grid.at("world_from_grid");
    for (int i = 0; i < 9; ++i)
      read.world_from_grid.rotation(i / 3, i % 3) =
          pose.at("rotation").at(static_cast<size_t>(i)).get<double>();
    read.world_from_grid.translation_mm = vector(pose.at("translation_mm"));
    voxel::validate(read);
    return read;
  } catch (const json::exception& e) {
    throw Error(ErrorKind::invalid_input, std::string("the recording's grid cannot be read: ") + e.what());
  }
}

ops::Tick tick_op(const TickReport& r) {
  const auto f = [](double value) { return static_cast<float>(value); };
  ops::Tick t;
  t.tick = r.tick;
  t.flags = flags_of(r);
  t.world_from_handle = r.world_from_handle_q;
  t.grid_from_tool = r.grid_from_tool;
  t.session_hash = r.session_hash;
  t.world_from_bone_rest = quantised(r.world_from_bone_rest);
  t.thrust_n = f(r.thrust_n);
  t.torque_n_mm = f(r.torque_n_mm);
  t.spindle_torque_n_mm = f(r.spindle_torque_n_mm);
  t.guide_force_n = f(r.guide_force_n);
  t.hand_force_x_n = f(r.hand_force_n.x());
  t.hand_force_y_n = f(r.hand_force_n.y());
  t.hand_force_z_n = f(r.hand_force_n.z());
  t.hand_vibration_x_n = f(r.hand_vibration_n.x());
  t.hand_vibration_y_n = f(r.hand_vibration_n.y());
  t.hand_vibration_z_n = f(r.hand_vibration_n.z());
  t.hand_torque_x_n_mm = f(r.hand_torque_n_mm.x());
  t.hand_torque_y_n_mm = f(r.hand_torque_n_mm.y());
  t.hand_torque_z_n_mm = f(r.hand_torque_n_mm.z());
  t.vibration_g = f(r.vibration_g);
  t.feed_rate_mm_s = f(r.feed_rate_mm_s);
  t.density_g_cc = f(r.density_g_cc);
  t.share_cancellous = f(r.share[0]);
  t.share_cortical = f(r.share[1]);
  t.share_cartilage = f(r.share[2]);
  t.engaged_points = static_cast<uint32_t>(r.engaged_points);
  t.removed_cancellous = static_cast<int32_t>(r.coverage_removed[0]);
  t.removed_cortical = static_cast<int32_t>(r.coverage_removed[1]);
  t.removed_cartilage = static_cast<int32_t>(r.coverage_removed[2]);
  t.changed_bricks = r.changed_bricks;
  t.spindle_speed_rad_s = f(r.spindle_speed_rad_s);
  t.surface_temperature_c = f(r.surface_temperature_c);
  return t;
}

TickReport report_of(const ops::Tick& t, const Pose& world_from_grid) {
  TickReport r;
  r.tick = t.tick;
  r.spindle_on = (t.flags & spindle_on_flag) != 0;
  r.paused = (t.flags & paused_flag) != 0;
  r.failed_over = (t.flags & failed_over_flag) != 0;
  r.engaged = (t.flags & engaged_flag) != 0;
  r.cutting = (t.flags & cutting_flag) != 0;
  r.weakened = (t.flags & weakened_flag) != 0;
  r.stale = (t.flags & stale_flag) != 0;
  r.stalled = (t.flags & stalled_flag) != 0;
  r.drive = drive_of_flags(t.flags);
  r.world_from_handle_q = t.world_from_handle;
  r.grid_from_tool = t.grid_from_tool;
  r.world_from_handle = dequantised(t.world_from_handle);
  r.world_from_bone_rest = dequantised(t.world_from_bone_rest);
  r.world_from_tool = r.world_from_bone_rest * world_from_grid * dequantised(t.grid_from_tool);
  r.session_hash = t.session_hash;
  r.thrust_n = t.thrust_n;
  r.torque_n_mm = t.torque_n_mm;
  r.spindle_torque_n_mm = t.spindle_torque_n_mm;
  r.guide_force_n = t.guide_force_n;
  r.hand_force_n = Vec3(t.hand_force_x_n, t.hand_force_y_n, t.hand_force_z_n);
  r.hand_vibration_n = Vec3(t.hand_vibration_x_n, t.hand_vibration_y_n, t.hand_vibration_z_n);
  r.hand_torque_n_mm = Vec3(t.hand_torque_x_n_mm, t.hand_torque_y_n_mm, t.hand_torque_z_n_mm);
  r.vibration_g = t.vibration_g;
  r.feed_rate_mm_s = t.feed_rate_mm_s;
  r.density_g_cc = t.density_g_cc;
  r.share[0] = t.share_cancellous;
  r.share[1] = t.share_cortical;
  r.share[2] = t.share_cartilage;
  r.engaged_points = t.engaged_points;
  r.coverage_removed[0] = t.removed_cancellous;
  r.coverage_removed[1] = t.removed_cortical;
  r.coverage_removed[2] = t.removed_cartilage;
  r.changed_bricks = t.changed_bricks;
  r.spindle_speed_rad_s = t.spindle_speed_rad_s;
  r.surface_temperature_c = t.surface_temperature_c;
  return r;
}

TickReport as_recorded(const TickReport& report, const Pose& world_from_grid) {
  return report_of(tick_op(report), world_from_grid);
}

Recording::Recording(const std::filesystem::path& path, Trust trust) : log_(path) {
  if (trust == Trust::checked) log_.check_all();
  try {
    read_notes();
  } catch (const Error&) {
    log_.check_all();
    read_notes();
  }
  for (size_t i = 0; i < log_.chunks().size(); ++i) {
    const ChunkPlace& place = log_.chunks()[i];
    if (place.ticks == 0) continue;
    tick_chunks_.push_back(i);
    tick_count_ = place.first_tick + place.ticks;
  }
}

void Recording::read_notes() {
  bool any_header = false;
  segments_.clear();
  events_.clear();
  annotations_.clear();
  end_.reset();
  const Taking take{[&](const ops::Header& op) {
                      header_ = op;
                      any_header = true;
                    },
                    [&](const ops::Segment& op) {
                      segments_.push_back(op);
                      end_.reset();
                    },
                    [&](const ops::Event& op) { events_.push_back(op); },
                    [&](const ops::Annotation& op) { annotations_.push_back(op); },
                    [&](const ops::End& op) { end_ = op; }};
  for (size_t i = 0; i < log_.chunks().size(); ++i)
    if (log_.chunks()[i].has_notes) ops::read(log_.read_chunk(i), log_.revision(), take);
  if (!any_header)
    throw Error(ErrorKind::invalid_input,
                log_.path().string() + " does not say what was simulated; it is no session's recording");
}

voxel::VoxelGrid Recording::grid() const {
  if (header_.grid.empty())
    throw Error(ErrorKind::invalid_input,
                log_.path().string() +
                    " is of an older revision that does not say where its voxels are, so "
                    "nothing can be measured in it");
  return grid_from_text(header_.grid);
}

size_t Recording::chunk_of(uint32_t tick) const {
  const std::vector<ChunkPlace>& chunks = log_.chunks();
  const auto after = std::partition_point(tick_chunks_.begin(), tick_chunks_.end(),
                                          [&](size_t i) { return chunks[i].first_tick <= tick; });
  return after == tick_chunks_.begin() ? 0 : *(after - 1);
}

std::vector<ops::Tick> Recording::rows_of(size_t i) const {
  const ChunkPlace& place = log_.chunks()[i];
  std::vector<ops::Tick> rows;
  rows.reserve(place.ticks);
  ops::read(log_.read_chunk(i), log_.revision(), Taking{[&](const ops::Tick& op) { rows.push_back(op); }});
  bool in_order = rows.size() == place.ticks;
  for (size_t k = 0; in_order && k < rows.size(); ++k) in_order = rows[k].tick == place.first_tick + k;
  if (!in_order)
    throw Error(ErrorKind::invalid_input, log_.path().string() +
                                              " does not hold the ticks that it announces from tick " +
                                              std::to_string(place.first_tick) + " on");
  return rows;
}

void Recording::for_each_tick(uint32_t first, uint32_t last,
                              const std::function<void(const ops::Tick&)>& visit) const {
  for (const size_t i : tick_chunks_) {
    const ChunkPlace& place = log_.chunks()[i];
    if (place.first_tick >= last) break;
    if (place.first_tick + place.ticks <= first) continue;
    for (const ops::Tick& row : rows_of(i))
      if (row.tick >= first && row.tick < last) visit(row);
  }
}

std::vector<ops::Tick> Recording::ticks(uint32_t first, uint32_t last) const {
  std::vector<ops::Tick> found;
  for_each_tick(first, last, [&](const ops::Tick& op) { found.push_back(op); });
  return found;
}

std::vector<ops::Checkpoint> Recording::checkpoints() const {
  std::vector<ops::Checkpoint> found;
  const Taking take{[&](const ops::Checkpoint& op) { found.push_back(op); }};
  for (const size_t i : tick_chunks_) ops::read(log_.read_chunk(i), log_.revision(), take);
  return found;
}

std::optional<ops::Checkpoint> Recording::last_checkpoint() const {
  std::optional<ops::Checkpoint> found;
  const Taking take{[&](const ops::Checkpoint& op) { found = op; }};
  for (size_t i = tick_chunks_.size(); i-- > 0 && !found;)
    ops::read(log_.read_chunk(tick_chunks_[i]), log_.revision(), take);
  return found;
}

}  // namespace ream::record
