#include "session/simulation/recording_header.hpp"

#include <nlohmann/json.hpp>

#include "case/plan.hpp"
#include "core/hash.hpp"
#include "core/new_id.hpp"
#include "core/version.hpp"
#include "record/recording.hpp"
#include "sim/settings.hpp"

namespace ream::session {
std::string table_hashes(const sim::Model& model) {
  nlohmann::json hashes = nlohmann::json::object();
  if (const uint64_t feed = model.feed->table_hash(); feed != 0) hashes["feed"] = to_hex(feed);
  if (model.vibration) hashes["vibration"] = to_hex(model.vibration->hash());
  return hashes.dump();
}

record::ops::Header header_of(const Rig& rig) {
  record::ops::Header header;
  header.build = version_text();
  header.case_id = rig.bone_case.id;
  header.case_hash = rig.case_hash;
  header.start_grid_hash = rig.bone_case.bone.coverage_hash();
  header.random_seed = rig.model.settings.random_seed;
  header.force_scale = rig.model.settings.force_scale;
  header.settings = sim::to_json(rig.model.settings).dump();
  header.plan = case_::to_json(rig.model.plan).dump();
  header.grid = record::grid_to_text(rig.bone_case.bone.grid);
  header.description = rig.description().dump();
  header.tables = table_hashes(rig.model);
  header.anatomy = case_::to_json(rig.anatomy).dump();
  return header;
}

record::ops::Segment segment_of(const Rig& rig, uint32_t first_tick, const std::string& reason) {
  record::ops::Segment segment;
  segment.first_tick = first_tick;
  segment.reason = reason;
  segment.utc = utc_now();
  segment.tool = rig.reamer.words;
  segment.tool_axis = axis_to_text(rig.reamer.axis);
  segment.tool_file = rig.reamer.mesh_file;
  segment.backend = rig.state.backend.name;
  return segment;
}

}  // namespace ream::session
