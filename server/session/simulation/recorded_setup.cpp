#include "session/simulation/recorded_setup.hpp"

#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/json.hpp"
#include "sim/settings.hpp"

namespace ream::session {
namespace {

/// A JSON text of a recording's header. Error invalid_input naming it.
nlohmann::json parsed(const std::string& text, const std::string& place) {
  try {
    return parse_json(text);
  } catch (const Error&) {
    throw Error(ErrorKind::invalid_input, place + " cannot be read");
  }
}

std::string place_of(const record::Recording& recording, const char* what) {
  return recording.log().path().string() + ": the " + what;
}

}  // namespace

case_::Case case_as_recorded(const record::Recording& recording, case_::Case found) {
  const uint64_t recorded = recording.header().case_hash;
  if (const uint64_t hash = case_::case_hash(found); hash != recorded)
    throw Error(ErrorKind::conflict, "the case '" + found.id + "' is not what was recorded (its hash is " +
                                         to_hex(hash) + ", recorded " + to_hex(recorded) +
                                         "); say where the old one is with --case");
  found.plan = recorded_plan(recording);
  return found;
}

case_::Plan recorded_plan(const record::Recording& recording) {
  const std::string place = place_of(recording, "recorded plan");
  return case_::plan_from_json(parsed(recording.header().plan, place), place);
}

case_::Anatomy anatomy_in(const record::Recording& recording) {
  const std::string place = place_of(recording, "recorded anatomy");
  return case_::anatomy_from_json(parsed(recording.header().anatomy, place), place);
}

sim::Settings recorded_settings(const record::Recording& recording, const std::string& backend) {
  const std::string place = place_of(recording, "recorded settings");
  sim::Settings settings = sim::settings_from_json(parsed(recording.header().settings, place), place);
  settings.backend = backend;
  return settings;
}

Reamer recorded_reamer(const record::Recording& recording, const record::ops::Segment& segment) {
  return {segment.tool, axis_from_text(segment.tool_axis, place_of(recording, "recorded reamer")),
          segment.tool_file};
}

void require_same_physics(const record::Recording& recording, const sim::Settings& settings) {
  if (settings.physics == sim::physics_revision) return;
  throw Error(ErrorKind::conflict, recording.log().path().string() + " was made with physics revision " +
                                       std::to_string(settings.physics) +
                                       ", and this build computes revision " +
                                       std::to_string(sim::physics_revision) +
                                       "; it can be watched and scored, but not computed again or resumed");
}

SimulationSetup recorded_setup(const record::Recording& recording, const record::ops::Segment& segment,
                               case_::Case bone_case, const sim::ResumeState& from,
                               const std::string& backend) {
  SimulationSetup parts;
  parts.request.case_name = bone_case.id;
  parts.request.backend = backend;
  parts.bone_case = std::move(bone_case);
  parts.case_hash = recording.header().case_hash;
  parts.reamer = recorded_reamer(recording, segment);
  parts.tool = tool_of(parts.reamer);
  parts.settings = recorded_settings(recording, backend);
  require_same_physics(recording, parts.settings);
  parts.from = from;
  return parts;
}

}  // namespace ream::session
