#include "shell/parametric_profile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "shell/reamer_library.hpp"

namespace ream::shell {
namespace {

constexpr double default_outer_radius_mm = 18.25;  // thesis, appendix A
constexpr double default_back_mm = 4.0;
constexpr double shaft_radius_mm = 4.0, shaft_length_mm = 5.0;
constexpr double chord_error_mm = 1e-4;
constexpr double max_length_mm = 1000.0;

/// Half an ellipsoid of revolution, cut off at outer_radius; a sphere has equal semi-axes.
struct Shape {
  double across_mm = 0, along_mm = 0, outer_radius_mm = 0;
  double nipple_radius_mm = 0, nipple_height_mm = 0;
  double back_mm = default_back_mm;
};

[[noreturn]] void refuse_description(const std::string& description, const std::string& why) {
  throw Error(ErrorKind::usage, "tool \"" + description + "\": " + why + "; " + tool_forms);
}

std::vector<std::string> split_words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// "a,b" as lengths, each over 0 and at most 1 m.
std::vector<double> lengths_mm(const std::string& description, const std::string& keyword,
                               const std::string& list) {
  std::vector<double> values;
  const char *at = list.data(), *end = at + list.size();
  while (true) {
    double value = 0.0;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || (rest != end && *rest != ','))
      refuse_description(description, "\"" + list + "\" after \"" + keyword + "\" is not a list of numbers");
    if (!(value > 0.0) || !(value <= max_length_mm))
      refuse_description(description,
                         "each length after \"" + keyword + "\" must be over 0 and at most 1000 mm");
    values.push_back(value);
    if (rest == end) return values;
    at = rest + 1;
  }
}

void read_part(const std::string& description, const std::string& keyword, const std::vector<double>& mm,
               Shape& shape) {
  const auto expect = [&](size_t least, size_t most) {
    if (mm.size() < least || mm.size() > most)
      refuse_description(description, "wrong count of numbers after \"" + keyword + "\"");
  };
  if (keyword == "sphere") {
    expect(1, 2);
    shape.across_mm = shape.along_mm = mm[0];
    shape.outer_radius_mm = mm.size() == 2 ? mm[1] : std::min(mm[0], default_outer_radius_mm);
    if (shape.outer_radius_mm > mm[0])
      refuse_description(description, "the outer radius is larger than the sphere");
  } else if (keyword == "ellipse") {
    expect(2, 2);
    shape.across_mm = shape.outer_radius_mm = mm[0];
    shape.along_mm = mm[1];
  } else if (keyword == "nipple") {
    expect(2, 2);
    shape.nipple_radius_mm = mm[0];
    shape.nipple_height_mm = mm[1];
    if (mm[0] >= shape.outer_radius_mm) refuse_description(description, "the nipple is as wide as the tool");
  } else {
    expect(1, 1);
    shape.back_mm = mm[0];
  }
}

Shape read_shape(const std::string& description) {
  const LibraryReamer* named = find_reamer(description);
  const std::vector<std::string> words = split_words(named ? named->words : description);
  Shape shape;
  size_t next_allowed = 0;  // body, nipple, back: each at most once and in this order
  for (size_t i = 0; i < words.size(); i += 2) {
    const std::string& keyword = words[i];
    const size_t rank = keyword == "sphere" || keyword == "ellipse" ? 0
                        : keyword == "nipple"                       ? 1
                        : keyword == "back"                         ? 2
                                                                    : 3;
    if (rank == 3) refuse_description(description, "unknown word \"" + keyword + "\"");
    if (rank < next_allowed || (i == 0) != (rank == 0))
      refuse_description(description, "\"" + keyword + "\" is misplaced");
    if (i + 1 == words.size())
      refuse_description(description, "numbers are missing after \"" + keyword + "\"");
    read_part(description, keyword, lengths_mm(description, keyword, words[i + 1]), shape);
    next_allowed = rank + 1;
  }
  return shape;
}

double cap_z_mm(const Shape& shape, double radius_mm) {
  const double x = radius_mm / shape.across_mm;
  return -shape.along_mm * (1.0 - std::sqrt(std::max(0.0, 1.0 - x * x)));
}

void add_segment(ToolProfile& profile, double radius_mm, double z_mm, SurfaceRole role) {
  profile.points.push_back({radius_mm, z_mm});
  profile.roles.push_back(role);
}

/// Equal steps of the ellipse's parameter; a chord is off by at most step^2 / 8 times the larger semi-axis.
void add_cap(ToolProfile& profile, const Shape& shape) {
  const double begin = std::asin(shape.nipple_radius_mm / shape.across_mm);
  const double end = std::asin(shape.outer_radius_mm / shape.across_mm);
  const double step = std::sqrt(8.0 * chord_error_mm / std::max(shape.across_mm, shape.along_mm));
  const int count = std::max(8, static_cast<int>(std::ceil((end - begin) / step)));
  for (int i = 1; i <= count; ++i) {
    const double t = begin + (end - begin) * i / count;
    const double radius = i == count ? shape.outer_radius_mm : shape.across_mm * std::sin(t);
    const double z = i == count ? cap_z_mm(shape, radius) : -shape.along_mm * (1.0 - std::cos(t));
    add_segment(profile, radius, z, SurfaceRole::cutting);
  }
}

}  // namespace

bool is_parametric(const std::string& description) {
  const std::vector<std::string> words = split_words(description);
  return !words.empty() && (words[0] == "sphere" || words[0] == "ellipse" || find_reamer(description));
}

ToolProfile parametric_profile(const std::string& description) {
  const Shape shape = read_shape(description);
  ToolProfile profile;
  if (shape.nipple_radius_mm > 0.0) {
    profile.points.push_back({0.0, shape.nipple_height_mm});
    add_segment(profile, shape.nipple_radius_mm, shape.nipple_height_mm, SurfaceRole::guiding);
    add_segment(profile, shape.nipple_radius_mm, cap_z_mm(shape, shape.nipple_radius_mm),
                SurfaceRole::guiding);
  } else {
    profile.points.push_back({0.0, 0.0});
  }
  add_cap(profile, shape);
  const double back_z = profile.points.back().z_mm - shape.back_mm;
  const double shaft_radius = std::min(shaft_radius_mm, 0.5 * shape.outer_radius_mm);
  add_segment(profile, shape.outer_radius_mm, back_z, SurfaceRole::smooth);
  add_segment(profile, shaft_radius, back_z, SurfaceRole::smooth);
  add_segment(profile, shaft_radius, back_z - shaft_length_mm, SurfaceRole::smooth);
  add_segment(profile, 0.0, back_z - shaft_length_mm, SurfaceRole::smooth);
  return profile;
}

}  // namespace ream::shell
