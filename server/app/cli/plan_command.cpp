#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/case_path.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/numbers.hpp"
#include "app/data_folder.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "ct/phantom_case.hpp"
#include "shell/tool.hpp"

namespace ream::app {
namespace {

struct Options {
  std::string case_name, axis, reamer, guide;
  std::optional<double> depth_mm, pilot_diameter_mm, pilot_depth_mm;
  bool no_pilot = false;
};

/// What the plan is before this command's options: the case's own, else straight through the face of its
/// glenoid.
case_::Plan starting_plan(const case_::Case& c, bool axis_given) {
  case_::Plan plan = c.plan.value_or(case_::Plan{});
  if (c.plan || axis_given) return plan;
  if (!c.glenoid)
    throw Error(ErrorKind::usage,
                "case '" + c.id + "' has no plan and no glenoid frame yet; give --axis X,Y,Z,DX,DY,DZ");
  plan.entry_mm = c.glenoid->centre_mm;
  plan.axis_direction = -c.glenoid->lateral;
  return plan;
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
}

void set_pilot(case_::Plan& plan, const Options& options) {
  if (options.no_pilot) plan.pilot_hole.reset();
  if (!options.pilot_diameter_mm && !options.pilot_depth_mm) return;
  case_::PilotHole hole = plan.pilot_hole.value_or(case_::PilotHole{});
  hole.diameter_mm = options.pilot_diameter_mm.value_or(hole.diameter_mm);
  hole.depth_mm = options.pilot_depth_mm.value_or(hole.depth_mm);
  plan.pilot_hole = hole;
}

/// Error usage or not_found for what is neither a form of tool nor a file; a mesh may still need an axis,
/// which `simulate` takes.
std::string checked_reamer(const std::string& reamer) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(reamer, failed)) shell::make_tool(reamer);
  return reamer;
}

void plan_case(const Options& options, const GlobalOptions& global) {
  const auto folder = case_path(options.case_name, global.data);
  const case_::Case c = options.case_name == "demo" ? ct::load_or_make_demo_case(data_folder(global.data))
                                                    : case_::load_case(folder);
  case_::Plan plan = starting_plan(c, !options.axis.empty());
  if (!options.axis.empty()) set_axis(plan, c, options.axis);
  if (options.depth_mm) plan.depth_mm = *options.depth_mm;
  if (!options.reamer.empty()) plan.reamer = checked_reamer(options.reamer);
  set_pilot(plan, options);
  if (!options.guide.empty()) plan.guide = case_::guide_from_text(options.guide);
  case_::save_plan(plan, folder);
  if (global.json) {
    std::cout << case_::to_json(plan).dump() << '\n';
    return;
  }
  std::cout << "entry " << plan.entry_mm.transpose() << " mm, direction " << plan.axis_direction.transpose()
            << ", depth " << plan.depth_mm << " mm, reamer " << plan.reamer;
  if (plan.pilot_hole)
    std::cout << ", pilot hole " << plan.pilot_hole->diameter_mm << " x " << plan.pilot_hole->depth_mm
              << " mm";
  std::cout << ", guide " << case_::to_text(plan.guide) << '\n' << (folder / "plan.json").string() << '\n';
}

}  // namespace

void add_plan_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plan", "Say where and how deep a case is to be reamed");
  command->add_option("CASE", options->case_name, "Name of a case, or its folder")->required();
  command->add_option("--axis", options->axis,
                      "X,Y,Z,DX,DY,DZ: a point of the axis and its direction into the bone, LPS mm");
  command->add_option("--depth-mm", options->depth_mm, "Depth past first contact of the cutting surface");
  command->add_option("--reamer", options->reamer, "'sphere R', 'ellipse A,B' or a mesh file");
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
