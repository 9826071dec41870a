#include "report/deviation_scale.hpp"

#include <algorithm>

#include "score/deviation.hpp"

namespace ream::report {
namespace {

constexpr render::VertexColour bone_colour{189, 183, 172, 0};

std::string in_words(const std::vector<DeviationClass>& classes) {
  std::string words;
  for (const DeviationClass& each : classes) words += (words.empty() ? "" : ", ") + each.words;
  return words;
}

std::vector<render::VertexColour> colours_of(std::span<const int8_t> codes,
                                             const std::vector<DeviationClass>& classes, double step) {
  std::vector<render::VertexColour> colours;
  colours.reserve(codes.size());
  for (const int8_t code : codes) {
    const auto of = std::find_if(classes.begin(), classes.end(),
                                 [&](const DeviationClass& each) { return code * step <= each.up_to; });
    colours.push_back(code == score::deviation_unknown ? bone_colour : of->colour);
  }
  return colours;
}

/// Percent.
const std::vector<DeviationClass>& strain_classes() {
  static const std::vector<DeviationClass> classes = {
      {0.1, {255, 255, 178, 0}, "up to 0.1 %"},
      {0.3, {254, 204, 92, 0}, "0.1 to 0.3 %"},
      {0.7, {240, 99, 42, 0}, "0.3 to 0.7 %"},
      {1e9, {128, 0, 38, 255}, "over 0.7 % (hatched)"},
  };
  return classes;
}

}  // namespace

const std::vector<DeviationClass>& deviation_classes() {
  static const std::vector<DeviationClass> classes = {
      {-1.0, {179, 88, 6, 0}, "over 1 mm too high"},
      {-0.5, {241, 163, 64, 0}, "0.5 to 1 mm too high"},
      {-0.25, {254, 224, 182, 0}, "0.25 to 0.5 mm too high"},
      {0.25, {247, 247, 247, 0}, "within 0.25 mm"},
      {0.5, {216, 218, 235, 255}, "0.25 to 0.5 mm too deep"},
      {1.0, {153, 142, 195, 255}, "0.5 to 1 mm too deep"},
      {1e9, {84, 39, 136, 255}, "over 1 mm too deep"},
  };
  return classes;
}

render::VertexColour deviation_colour(int8_t code) {
  if (code == score::deviation_unknown) return bone_colour;
  const double mm = score::deviation_mm(code);
  for (const DeviationClass& each : deviation_classes())
    if (mm <= each.up_to) return each.colour;
  return bone_colour;
}

const std::vector<DeviationClass>& wall_classes() {
  static const std::vector<DeviationClass> classes = {
      {2.0, {8, 29, 88, 255}, "up to 2 mm (hatched)"}, {5.0, {34, 94, 168, 0}, "2 to 5 mm"},
      {10.0, {65, 182, 196, 0}, "5 to 10 mm"},         {15.0, {161, 218, 180, 0}, "10 to 15 mm"},
      {1e9, {255, 255, 204, 0}, "over 15 mm"},
  };
  return classes;
}

std::string wall_classes_in_words() { return in_words(wall_classes()); }

std::vector<render::VertexColour> wall_colours(std::span<const int8_t> codes) {
  return colours_of(codes, wall_classes(), score::wall_step_mm);
}

std::string strain_classes_in_words() { return in_words(strain_classes()); }

std::vector<render::VertexColour> strain_colours(std::span<const int8_t> codes) {
  return colours_of(codes, strain_classes(), 100.0 * strain_step);
}

std::vector<render::VertexColour> deviation_colours(std::span<const int8_t> codes) {
  std::vector<render::VertexColour> colours;
  colours.reserve(codes.size());
  for (const int8_t code : codes) colours.push_back(deviation_colour(code));
  return colours;
}

}  // namespace ream::report
