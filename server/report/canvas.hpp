#pragma once
#include <span>
#include <string>

namespace ream::report {

/// A place on paper, points (1/72 inch) from the top left corner.
struct Place {
  double x = 0.0, y = 0.0;
};

/// sRGB, 0 to 1.
struct Ink {
  double red = 0.0, green = 0.0, blue = 0.0;
};
constexpr Ink grey(double level) { return {level, level, level}; }

struct Stroke {
  double width = 0.75;
  Ink ink;
  bool dashed = false;
};

enum class Anchor { left, middle, right };

struct Lettering {
  double size = 7.5;
  Ink ink;
  Anchor anchor = Anchor::left;
  bool bold = false;
  bool upwards = false;  ///< turned by a quarter, to be read from the right
};

/// What charts are drawn on: a page, or a picture of lines.
class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual void fill(std::span<const Place> polygon, const Ink& ink) = 0;
  virtual void line(std::span<const Place> path, const Stroke& stroke) = 0;
  /// `at` is on the base line of the letters.
  virtual void text(const Place& at, const std::string& words, const Lettering& lettering) = 0;

  void fill_box(const Place& from, const Place& to, const Ink& ink) {
    const Place corners[] = {from, {to.x, from.y}, to, {from.x, to.y}};
    fill(corners, ink);
  }
  void straight(const Place& from, const Place& to, const Stroke& stroke) {
    const Place ends[] = {from, to};
    line(ends, stroke);
  }
};

/// Collects SVG elements; `svg` puts them into one picture of that size.
class SvgCanvas final : public Canvas {
 public:
  void fill(std::span<const Place> polygon, const Ink& ink) override;
  void line(std::span<const Place> path, const Stroke& stroke) override;
  void text(const Place& at, const std::string& words, const Lettering& lettering) override;

  /// `alt_text` is what readers for the blind say.
  std::string svg(double width, double height, const std::string& alt_text) const;

 private:
  std::string elements_;
};

/// Text as it stands in HTML and SVG.
std::string escaped(const std::string& text);

}  // namespace ream::report
