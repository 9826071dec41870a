#pragma once
#include <string>
#include <vector>

#include "render/snapshot.hpp"

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

}  // namespace ream::report
