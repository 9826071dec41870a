#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "render/snapshot.hpp"
#include "report/trace_summary.hpp"
#include "score/benchmark.hpp"
#include "score/learning_curve.hpp"
#include "score/rubric_score.hpp"

namespace ream::report {

/// Words on a picture; their middle as shares of its width from the left and of its height from the top.
struct PictureLabel {
  double x = 0.5, y = 0.5;
  std::string words;
};

struct Picture {
  std::string title, caption;
  render::Image image;
  std::vector<PictureLabel> labels;
  bool is_map = false;  ///< of deviations, which needs their legend
};

/// Who did what, with what; empty texts where it is not known.
struct SessionFacts {
  std::string id, case_name, side;
  std::string trainee;      ///< name, or the code that stands for it in a study
  bool blinded = false;     ///< trainee is such a code
  std::string created_utc;  ///< ISO
  int attempt = 0;          ///< from 1; 0: not known
  bool theatre = false;     ///< theatre mode: nothing but the bone is shown while reaming
  std::string state, fault;
  std::string reamer, device, device_profile, feed_model, guide;
  double force_scale = 1.0;
  std::string build, scored_by;  ///< versions of the program
  std::string case_hash, start_grid_hash, grid_hash, session_hash;
};

/// A remark of somebody at some time of the session.
struct Remark {
  double at_s = 0.0;
  std::string words, author;
};

/// A component on the glenoid in one state, under the worst of its loads.
struct LoadedGlenoid {
  std::string name;  ///< "Before", "As planned", "As reamed"
  double supported_percent = 0.0, support_lost_percent = 0.0;
  double motion_um = 0.0;
  std::optional<double> plate_strain;  ///< 99 % of the plate under the component has less
  double overstrained_percent = 0.0;
};

/// A component under load on bone, for the report's own page.
struct LoadMaterial {
  double force_n = 0.0, cell_mm = 0.0;
  std::string law;  ///< of the bone's modulus
  bool settled = true;
  std::vector<LoadedGlenoid> states;
  std::optional<Picture> map;
};

/// Everything that a report is made of.
struct Material {
  SessionFacts session;
  std::string plan_words;  ///< reamer, depth, hole and implant of the plan, for people
  double planned_depth_mm = 0.0;
  nlohmann::json metrics;  ///< as metrics.json
  score::Rubric rubric;
  score::Score score;
  std::optional<score::Benchmark> benchmark;
  std::optional<TraceSummary> trace;
  std::vector<Remark> remarks;
  score::LearningCurve learning;  ///< the trainee's sessions up to this one; may be empty
  std::vector<Picture> pictures;
  std::string why_no_pictures;  ///< one sentence, where there are none
  std::optional<LoadMaterial> load;
};

}  // namespace ream::report
