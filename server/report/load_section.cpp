#include <functional>

#include "report/number_text.hpp"
#include "report/report.hpp"

namespace ream::report {

LoadSection load_section(const LoadMaterial& m) {
  LoadSection section;
  section.words =
      "A component is seated on the glenoid and pressed with " + shortest(m.force_n) +
      " N: on its middle, and half way to its rim in four directions. Of each figure the worst of "
      "the five loads is given.";
  section.assumptions = "Finite elements, " + shortest(m.cell_mm) + " mm wide; bone by " + m.law +
                        "; a polyethylene component (600 MPa) without pegs; cement (2000 MPa) fills gaps of "
                        "up to 0.5 mm. It does "
                        "not slip where it is pressed, and lifts off elsewhere. Bone is held 8 mm beside the "
                        "component and 25 mm "
                        "behind the face. 0.7 % is the level of Pistoia 2002, who had much finer elements. "
                        "These figures compare "
                        "states of one glenoid. They do not predict whether a component loosens.";
  if (!m.settled) section.assumptions += " Not every load has settled: these figures are rough.";
  section.heads = {""};
  for (const LoadedGlenoid& state : m.states) section.heads.push_back(state.name);
  const auto add = [&](const char* name, const std::function<std::string(const LoadedGlenoid&)>& text) {
    std::vector<std::string> row = {name};
    for (const LoadedGlenoid& state : m.states) row.push_back(text(state));
    section.rows.push_back(std::move(row));
  };
  add("Supported by bone, without load",
      [](const LoadedGlenoid& s) { return with_unit(s.supported_percent, "%"); });
  add("Support that a load lifts off",
      [](const LoadedGlenoid& s) { return with_unit(s.support_lost_percent, "%"); });
  add("Micromotion index: component against bone",
      [](const LoadedGlenoid& s) { return decimal(s.motion_um, 0) + "\u00a0\u00b5m"; });
  add("Peak strain of the subchondral plate", [](const LoadedGlenoid& s) {
    return s.plate_strain ? decimal(100.0 * *s.plate_strain, 2) + "\u00a0%" : std::string("no plate is left");
  });
  add("Bone within 3 mm that is strained beyond 0.7\u00a0%",
      [](const LoadedGlenoid& s) { return decimal(s.overstrained_percent, 1) + "\u00a0%"; });
  section.map = m.map;
  return section;
}

}  // namespace ream::report
