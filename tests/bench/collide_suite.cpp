#include "bench/collide_parts.hpp"
#include "ct/phantom/phantom_case.hpp"

namespace ream::bench {

std::vector<Row> collide_suite(const Options& options) {
  const ct::PhantomPreset preset = ct::phantom_preset("thesis-5-4-2");
  const case_::Case bone_case = ct::make_phantom_case("thesis-5-4-2", preset.params, preset.upsample);
  const auto shell = shell::make_point_shell(shell::make_tool(shell::thesis_tool), 0.1);
  std::vector<Row> rows{{"collide", "thesis-5-4-2 filled voxels",
                         static_cast<double>(bone_case.bone.filled_voxels()), 12.7e6, "voxels", 0.0},
                        {"collide", "thesis-5-4-2 shell points", static_cast<double>(shell.points.size()),
                         213e3, "points", 0.0}};
  const auto append = [&rows](std::vector<Row> more) {
    rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  append(memory_rows(bone_case, shell));
  append(tick_rows(bone_case));
  append(share_inside_rows(bone_case));
  if (options.baselines) append(thesis_tables(options));
  return rows;
}

}  // namespace ream::bench
