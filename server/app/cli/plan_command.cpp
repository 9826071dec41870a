#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/commands.hpp"
#include "app/numbers.hpp"
#include "case/measures.hpp"
#include "case/plan.hpp"
#include "case/planning.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"
#include "core/units.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "report/number_text.hpp"
#include "score/plan_outcome.hpp"
#include "session/simulation/reamer.hpp"
#include "shell/reamer_library.hpp"
#include "shell/tool.hpp"

namespace ream::app {
namespace {

struct PlanOptions {
  std::string case_name, axis, reamer, guide, override_reason, implant;
  std::filesystem::path landmarks;
  std::optional<double> version_deg, inclination_deg, implant_radius_mm;
  std::optional<double> depth_mm, pilot_diameter_mm, pilot_depth_mm;
  bool no_pilot = false, replace = false;

  bool by_angles() const { return version_deg || inclination_deg; }
};

/// A case with the landmarks it is planned by.
struct Patient {
  case_::Case bone_case;
  std::optional<case_::Landmarks> landmarks;
};

case_::Plan through_face(const case_::Case& c) {
  if (!c.glenoid)
    throw Error(ErrorKind::usage,
                "case '" + c.id +
                    "' has no plan, no landmarks and no glenoid frame yet; give --landmarks "
                    "FILE or --axis X,Y,Z,DX,DY,DZ");
  case_::Plan plan;
  plan.entry_mm = c.glenoid->centre_mm;
  plan.axis_direction = -c.glenoid->lateral;
  return plan;
}

case_::Plan proposed(const PlanOptions& options, const Patient& patient) {
  const case_::Case& c = patient.bone_case;
  if (!patient.landmarks)
    throw Error(ErrorKind::usage,
                "case '" + c.id +
                    "' has no landmarks, which version and inclination are measured from; give "
                    "--landmarks FILE");
  case_::PlanTargets targets;
  if (options.version_deg) targets.version_rad = radians_from_degrees(*options.version_deg);
  if (options.inclination_deg) targets.inclination_rad = radians_from_degrees(*options.inclination_deg);
  targets.depth_mm = options.depth_mm;
  targets.implant_radius_mm = options.implant_radius_mm;
  targets.reamer = options.reamer;
  if (c.plan) {
    if (!targets.depth_mm) targets.depth_mm = c.plan->depth_mm;
    if (!targets.implant_radius_mm) targets.implant_radius_mm = c.plan->implant_radius_mm;
    if (targets.reamer.empty() && !options.implant_radius_mm) targets.reamer = c.plan->reamer;
    targets.implant_size = c.plan->implant_size;
  }
  return case_::propose_plan(targets, *patient.landmarks, c.side, [&](const Vec3& point, const Vec3& along) {
    return case_::surface_along(c.bone, point, along);
  });
}

void set_axis(case_::Plan& plan, const case_::Case& c, const std::string& axis) {
  const auto n = parse_numbers(axis, 6, "--axis");
  const Vec3 through(n[0], n[1], n[2]), direction(n[3], n[4], n[5]);
  if (!(direction.norm() > 1e-9))
    throw Error(ErrorKind::usage, "--axis: the direction DX,DY,DZ must not be zero");
  const auto entry = case_::surface_along(c.bone, through, direction);
  if (!entry)
    throw Error(ErrorKind::invalid_input,
                "the axis " + axis + " misses the bone of case '" + c.id + "'; points are LPS mm");
  plan.entry_mm = *entry;
  plan.axis_direction = direction.normalized();
  plan.target_version_rad.reset();
  plan.target_inclination_rad.reset();
}

/// What the plan is before the options that only change it: by wanted angles where they are given, else the
/// case's own, else by the landmarks, else straight through the face of the glenoid.
case_::Plan starting_plan(const PlanOptions& options, const Patient& patient) {
  const case_::Case& c = patient.bone_case;
  if (options.by_angles()) return proposed(options, patient);
  if (c.plan) return *c.plan;
  if (!options.axis.empty()) return {};
  return patient.landmarks ? proposed(options, patient) : through_face(c);
}

void set_pilot(case_::Plan& plan, const PlanOptions& options) {
  if (options.no_pilot) plan.pilot_hole.reset();
  if (!options.pilot_diameter_mm && !options.pilot_depth_mm) return;
  case_::PilotHole hole = plan.pilot_hole.value_or(case_::PilotHole{});
  hole.diameter_mm = options.pilot_diameter_mm.value_or(hole.diameter_mm);
  hole.depth_mm = options.pilot_depth_mm.value_or(hole.depth_mm);
  plan.pilot_hole = hole;
}

/// As the plan names it. Error usage or not_found for what is neither a form of tool, nor in the library, nor
/// a file; a mesh may still need an axis, which `simulate` takes.
std::string checked_reamer(const std::string& asked_for, const std::filesystem::path& data) {
  if (asked_for.empty()) return asked_for;
  const std::string reamer = session::reamer_in_library(asked_for, data);
  std::error_code failed;
  if (!std::filesystem::is_regular_file(reamer, failed)) shell::make_tool(reamer);
  return reamer;
}

case_::Plan changed_plan(const PlanOptions& options, const Patient& patient) {
  case_::Plan plan = starting_plan(options, patient);
  if (!options.axis.empty()) set_axis(plan, patient.bone_case, options.axis);
  if (options.depth_mm) plan.depth_mm = *options.depth_mm;
  if (options.implant_radius_mm) {
    plan.implant_radius_mm = options.implant_radius_mm;
    if (options.reamer.empty()) plan.reamer = shell::reamer_for_implant(*options.implant_radius_mm).name;
  }
  if (!options.reamer.empty()) plan.reamer = options.reamer;
  if (!options.implant.empty()) plan.implant_size = options.implant;
  set_pilot(plan, options);
  if (!options.guide.empty()) plan.guide = case_::guide_from_text(options.guide);
  return plan;
}

/// What the plan reaches where it is carried out exactly.
void print(const score::MetricResults& outcome) {
  if (!outcome.value("footprint_area_mm2")) log::warn("the reamer does not touch the face of the glenoid");
  if (outcome.value("parts_through_vault").value_or(0.0) > 0.0)
    log::warn("a peg or keel of the implant perforates the vault");
  for (const std::string_view key : score::outcome_metrics)
    if (const auto value = outcome.value(key))
      std::cout << "  " << score::find_metric(key)->name << ": "
                << report::with_unit(*value, score::find_metric(key)->unit) << '\n';
}

void print(const case_::Plan& plan, const case_::PlanAssessment& assessment,
           const score::MetricResults& outcome, const std::filesystem::path& folder) {
  std::cout << "entry " << plan.entry_mm.transpose() << " mm, direction " << plan.axis_direction.transpose()
            << ", depth " << plan.depth_mm << " mm, reamer " << plan.reamer;
  if (plan.pilot_hole)
    std::cout << ", pilot hole " << plan.pilot_hole->diameter_mm << " x " << plan.pilot_hole->depth_mm
              << " mm";
  std::cout << ", guide " << case_::to_text(plan.guide) << '\n';
  if (assessment.version_before_rad && assessment.version_after_rad)
    std::cout << "before: " << case_::version_in_words(*assessment.version_before_rad) << ", "
              << case_::inclination_in_words(*assessment.inclination_before_rad)
              << "; after: " << case_::version_in_words(*assessment.version_after_rad) << ", "
              << case_::inclination_in_words(*assessment.inclination_after_rad) << '\n';
  std::cout << "predicted, if it is carried out exactly:\n";
  print(outcome);
  std::cout << (folder / "plan.json").string() << '\n';
}

void require_possible_depth(const case_::Plan& plan, const case_::PlanAssessment& assessment,
                            const PlanOptions& options, const std::optional<case_::Plan>& before) {
  if (!assessment.vault_depth_mm || plan.depth_mm < *assessment.vault_depth_mm) return;
  if (before && before->depth_mm == plan.depth_mm && before->axis_direction == plan.axis_direction &&
      before->entry_mm == plan.entry_mm)
    return;
  if (!options.override_reason.empty()) return;
  std::ostringstream words;
  words << std::fixed << std::setprecision(1) << "a depth of " << plan.depth_mm
        << " mm goes through the bone, of which " << *assessment.vault_depth_mm
        << " mm lie along the axis: --override REASON";
  throw Error(ErrorKind::conflict, words.str());
}

void plan_case(PlanOptions options, const GlobalOptions& global) {
  const auto folder = case_path(options.case_name, global.data);
  const auto data = data_folder(global.data);
  options.reamer = checked_reamer(options.reamer, data);
  Patient patient{options.case_name == "demo" ? ct::load_or_make_demo_case(data) : case_::load_case(folder),
                  case_::load_landmarks(folder)};
  if (!options.landmarks.empty())
    patient.landmarks =
        case_::landmarks_from_json(read_json_file(options.landmarks), options.landmarks.string());
  const case_::Case& c = patient.bone_case;
  case_::Plan plan = changed_plan(options, patient);
  case_::validate(plan, "plan of " + folder.string());
  const case_::Landmarks landmarks = patient.landmarks.value_or(case_::Landmarks{});
  const auto assess = [&] {
    return case_::assess_plan(plan, landmarks, c.side, &c.bone, c.glenoid ? &*c.glenoid : nullptr);
  };
  case_::PlanAssessment assessment = assess();
  if (assessment.needs_override && !options.override_reason.empty()) {
    plan.override_correction = true;
    plan.override_reason = options.override_reason;
    assessment = assess();
  }
  const bool same_axis = c.plan && c.plan->axis_direction == plan.axis_direction;
  if (assessment.needs_override && !same_axis)
    throw Error(ErrorKind::conflict, case_::why_refused(assessment) + ": --override REASON");
  require_possible_depth(plan, assessment, options, c.plan);
  std::error_code failed;
  const bool is_demo = std::filesystem::equivalent(folder, cases_folder(data) / "demo", failed);
  const bool changes =
      !options.landmarks.empty() || (c.plan && case_::to_json(*c.plan) != case_::to_json(plan));
  if (is_demo && changes && !options.replace)
    throw Error(
        ErrorKind::conflict,
        "this would change the plan of the built-in demo for everybody who uses this data folder: --replace");
  const score::Task task{
      {c.side, landmarks, c.glenoid}, plan, session::tool_asked_for(plan.reamer, data).profile};
  const score::MetricResults outcome = score::plan_outcome({task, c.bone});
  if (!options.landmarks.empty()) case_::save_landmarks(landmarks, folder);
  case_::save_plan(plan, folder);
  for (const std::string& warning : assessment.warnings) log::warn(warning);
  if (!global.json) return print(plan, assessment, outcome, folder);
  nlohmann::json answer = case_::to_json(plan);
  answer["assessment"] = case_::to_json(assessment);
  answer["outcome"] = score::outcome_json(outcome);
  answer["measures"] = case_::to_json(case_::measure(landmarks, c.side));
  std::cout << answer.dump() << '\n';
}

void add_axis_options(CLI::App& command, PlanOptions& options) {
  auto* axis = command.add_option(
      "--axis", options.axis, "X,Y,Z,DX,DY,DZ: a point of the axis and its direction into the bone, LPS mm");
  command.add_option("--landmarks", options.landmarks,
                     "landmarks.json (proto/landmarks.schema.json); kept with the case");
  command
      .add_option("--version-deg", options.version_deg,
                  "Wanted version (3D), retroversion negative; by the landmarks")
      ->check(CLI::Range(-40.0, 40.0))
      ->excludes(axis);
  command
      .add_option("--inclination-deg", options.inclination_deg,
                  "Wanted inclination (3D), superior positive; by the landmarks")
      ->check(CLI::Range(-40.0, 40.0))
      ->excludes(axis);
  command.add_option("--override", options.override_reason,
                     "Why a correction of 15 degrees or more by reaming alone, or a depth through the bone, "
                     "is taken all the same");
}

}  // namespace

void add_plan_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand("plan", "Say where and how deep a case is to be reamed");
  command->add_option("CASE", options->case_name, "Name of a case, or its folder")->required();
  add_axis_options(*command, *options);
  command->add_flag("--replace", options->replace, "Change the plan of the built-in demo");
  command->add_option("--depth-mm", options->depth_mm, "Depth past first contact of the cutting surface");
  command->add_option("--implant", options->implant,
                      "Component: pegged or keeled, small, medium or large (\"pegged medium\"), or as its "
                      "maker names it; pegs and keels of the first are scored");
  command->add_option("--implant-radius-mm", options->implant_radius_mm,
                      "Radius of the component's back; picks the reamer unless --reamer does");
  command->add_option("--reamer", options->reamer,
                      "Name of a reamer (built in, or a mesh in the data folder's reamers), 'sphere R', "
                      "'ellipse A,B' or a mesh file");
  auto* no_pilot = command->add_flag("--no-pilot", options->no_pilot, "No pilot hole");
  command->add_option("--pilot-diameter-mm", options->pilot_diameter_mm, "Diameter of the pilot hole")
      ->excludes(no_pilot);
  command->add_option("--pilot-depth-mm", options->pilot_depth_mm, "Depth of the pilot hole below the entry")
      ->excludes(no_pilot);
  command
      ->add_option("--guide", options->guide,
                   "What leads the reamer along the axis: none, nipple (in the pilot hole) or pin")
      ->check(CLI::IsMember({"none", "nipple", "pin"}));
  command->callback([options, &global] { plan_case(*options, global); });
}

}  // namespace ream::app
