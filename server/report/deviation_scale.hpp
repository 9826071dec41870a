#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/snapshot.hpp"

namespace ream::report {

/// One class of deviations (mm), of walls (mm) or of strains (percent), coloured and hatched the same. Purple
/// to orange over white is told apart by all kinds of colour blindness (ColorBrewer PuOr); what is hatched is
/// told apart without colour.
struct DeviationClass {
  double up_to = 0.0;  ///< including it; the last one has no end
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

/// Steps in which strain is told.
inline constexpr double strain_step = 1e-4;
/// Effective strain from little to over 0.7 % (the level of Pistoia 2002; hatched): the darker
/// the more, ColorBrewer YlOrRd. "up to 0.1 %, 0.1 to 0.3 %, ...".
std::string strain_classes_in_words();
/// Of codes, each so many strain_step; bone's own colour where nothing is known.
std::vector<render::VertexColour> strain_colours(std::span<const int8_t> codes);

}  // namespace ream::report
