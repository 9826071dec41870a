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

record::ops::Header header_of(const Simulation& simulation) {
  record::ops::Header header;
  header.build = version_text();
  header.case_id = simulation.bone_case.id;
  header.case_hash = simulation.case_hash;
  header.start_grid_hash = simulation.bone_case.bone.coverage_hash();
  header.random_seed = simulation.model.settings.random_seed;
  header.force_scale = simulation.model.settings.force_scale;
  header.settings = sim::to_json(simulation.model.settings).dump();
  header.plan = case_::to_json(simulation.model.plan).dump();
  header.grid = record::grid_to_text(simulation.bone_case.bone.grid);
  header.description = simulation.description().dump();
  header.tables = table_hashes(simulation.model);
  header.anatomy = case_::to_json(simulation.anatomy).dump();
  return header;
}

record::ops::Segment segment_of(const Simulation& simulation, uint32_t first_tick,
                                const std::string& reason) {
  record::ops::Segment segment;
  segment.first_tick = first_tick;
  segment.reason = reason;
  segment.utc = utc_now();
  segment.tool = simulation.reamer.words;
  segment.tool_axis = axis_to_text(simulation.reamer.axis);
  segment.tool_file = simulation.reamer.mesh_file;
  segment.backend = simulation.state.backend.name;
  return segment;
}

}  // namespace ream::session
