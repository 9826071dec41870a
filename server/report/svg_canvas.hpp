#pragma once
#include <string>

#include "report/canvas.hpp"

namespace ream::report {

/// Collects SVG elements; `svg` puts them into one picture of that size.
class SvgCanvas final : public Canvas {
 public:
  void fill(std::span<const Place> polygon, const Ink& ink) override;
  void line(std::span<const Place> path, const Stroke& stroke) override;
  void text(const Place& at, const std::string& words, const Lettering& lettering) override;

  /// `in_words` is what readers for the blind say.
  std::string svg(double width, double height, const std::string& in_words) const;

 private:
  std::string elements_;
};

/// Text as it stands in HTML and SVG.
std::string escaped(const std::string& text);

}  // namespace ream::report
