#include "bench/pecking.hpp"

#include <nlohmann/json.hpp>

#include "core/data_folder.hpp"
#include "ct/phantom/phantom_case.hpp"
#include "shell/tool.hpp"

namespace ream::bench {
namespace {

constexpr double peck_every_s = 5.0;

}  // namespace

void keep_thesis_case(const std::filesystem::path& data) {
  const ct::PhantomPreset preset = ct::phantom_preset(thesis_case);
  case_::Case bone_case = ct::make_phantom_case(thesis_case, preset.params, preset.upsample);
  bone_case.plan->reamer = shell::thesis_tool;
  case_::save_case(bone_case, cases_folder(data) / thesis_case);
}

nlohmann::json pecking(double duration_s, double press_n, double specimen_factor) {
  nlohmann::json profile = nlohmann::json::array();
  const auto add = [&](double t_s, double force_n) {
    profile.push_back({{"t_s", t_s}, {"force_n", force_n}});
  };
  add(0.0, 10.0);
  add(0.5, press_n);
  for (double t = peck_every_s; t < duration_s; t += peck_every_s) {
    add(t - 0.4, press_n);
    add(t - 0.3, -8.0);
    add(t - 0.1, -8.0);
    add(t, 10.0);
    add(t + 0.3, press_n);
  }
  return {{"device", "hand"},
          {"duration_s", duration_s},
          {"stiffness_n_mm", 100.0},
          {"specimen_factor", specimen_factor},
          {"hand", {{"start_mm", {0.0, 0.0, -8.0}}, {"force_profile", profile}}}};
}

}  // namespace ream::bench
