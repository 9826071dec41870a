#pragma once
#include "case/landmarks.hpp"
#include "core/file.hpp"
#include "session/simulation/session_setup.hpp"
#include "support/random_reaming.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {

/// A reaming as a session of the product: its case and script are written into `folder`. On the C++ form; the
/// points that feel are 0.4 mm apart, as what is cut does not depend on them.
inline session::SimulationSetup setup_of(const RandomReaming& reaming, double voxel_mm,
                                         const TemporaryFolder& folder) {
  const auto data = folder.path() / "data";
  case_::Case c;
  c.id = c.name = "glenoid";
  c.side = reaming.glenoid.shoulder.side;
  c.bone = bone_of(reaming.glenoid, voxel_mm);
  c.plan = reaming.plan;
  const case_::Landmarks landmarks = shoulder_landmarks(reaming.glenoid.shoulder);
  c.glenoid = case_::glenoid_frame(landmarks, c.side);
  case_::save_case(c, data / "cases/glenoid");
  case_::save_landmarks(landmarks, data / "cases/glenoid");
  write_file_atomically(folder.path() / "script.json", reaming.script.dump());
  session::RunRequest request;
  request.case_name = "glenoid";
  request.script_name = (folder.path() / "script.json").string();
  request.backend = "cpu";
  request.tool_spacing_mm = 0.4;
  return session::build_setup(request, data);
}

}  // namespace ream::test
