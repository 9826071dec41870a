#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/snapshot.hpp"

namespace ream::report {

/// One class of deviations: up to so much of a mm, coloured and hatched the same. Purple to orange over white
/// is told apart by all kinds of colour blindness (ColorBrewer PuOr); what is hatched is told apart without
/// colour.
struct DeviationClass {
  double up_to_mm = 0.0;  ///< including it; the last one has no end
  render::VertexColour colour;
  std::string words;  ///< "0.25 to 0.5 mm"
};

/// From bone that stands proud (negative) over what is as it should be (within 0.25 mm) to too much removed
/// (positive, hatched).
const std::vector<DeviationClass>& deviation_classes();

/// Colour of a code of score/deviation.hpp; bone's own where nothing is known.
render::VertexColour deviation_colour(int8_t code);
std::vector<render::VertexColour> deviation_colours(std::span<const int8_t> codes);

/// Thickness of a wall, from the thinnest: the darker the thinner, ColorBrewer YlGnBu; the thinnest is
/// hatched.
const std::vector<DeviationClass>& wall_classes();
/// "up to 2 mm (hatched), 2 to 5 mm, ...".
std::string wall_classes_in_words();
/// Of codes of score::wall_codes; bone's own colour where nothing is known.
std::vector<render::VertexColour> wall_colours(std::span<const int8_t> codes);

}  // namespace ream::report
