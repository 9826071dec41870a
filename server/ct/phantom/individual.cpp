#include "ct/phantom/individual.hpp"

#include <algorithm>

#include "core/hash.hpp"
#include "core/units.hpp"

namespace ream::ct {
namespace {

/// What is drawn of a person; the order is kept, as numbers mean the same people for ever.
enum class Trait : uint64_t {
  height,
  width,
  version,
  inclination,
  radius,
  plate,
  shell,
  joint_space,
  size,
  acromion_out,
  above_head,
  coracoid_out,
  coracoid_front,
  bow
};

// Nobody lies farther out than so many standard deviations: with them all shoulders can be reamed.
constexpr double max_deviations = 2.2;

struct Spread {
  double mean, sd;
};

class Person {
 public:
  explicit Person(uint64_t number) : number_(mix64(number)) {}

  /// About normally distributed: the sum of twelve uniform ones (Irwin and Hall), the same bits everywhere.
  double deviations(Trait trait) const {
    double sum = -6.0;
    uint64_t state = hash_combine(number_, static_cast<uint64_t>(trait));
    for (int i = 0; i < 12; ++i) {
      state = mix64(state + 0x9e3779b97f4a7c15);
      sum += static_cast<double>(state >> 11) * 0x1p-53;
    }
    return std::clamp(sum, -max_deviations, max_deviations);
  }
  double draw(Trait trait, const Spread& spread) const { return spread.mean + spread.sd * deviations(trait); }

 private:
  uint64_t number_;
};

// Glenoid: height 35.1 +- 4.1 (Chen 2023, 501 people) to 37.5 +- 3.8 mm (Lenart 2014); width 24.4 +- 2.9 to
// 26.0 +- 3.4 in the same, which mostly follows the height; radius of the bone 32 to 41 mm.
constexpr Spread height_mm{36.5, 3.5}, radius_mm{34.5, 3.0}, beside_height_mm{0.0, 1.5};
constexpr double width_per_height = 0.68;
// Angles: version -1.2 (Churchill 2001, 344 scapulae) to -5.2 degrees, inclination 4.2 to 8.4 (19 donors of
// 82 years, BMC Musculoskelet Disord 2021), both with spreads of about 5.
constexpr Spread version_deg{-3.0, 4.5}, inclination_deg{5.0, 4.0};
// Subchondral plate 1.9 mm, 1.2 to 2.9 (Frich 1998).
constexpr Spread plate_mm{1.9, 0.32};
// Chosen about the simple phantom's, without a series.
constexpr Spread shell_mm{1.2, 0.15}, joint_space_mm{4.0, 0.5}, body_bow_mm{6.0, 1.5};
// The following are chosen so that what is measured on the bones agrees with the series.
// Length of the scapula 139.3 +- 11.1 and 141.8 +- 10.9 mm; the mean shape has 150. Half of it goes with the
// glenoid's height.
constexpr double mean_scale = 0.95, scale_per_height = 0.55;
constexpr Spread scale_beside_height{0.0, 0.055};
// Critical shoulder angle 29.8 +- 3.5 degrees (Mah 2021), acromion to coracoid 31.1 +- 4.1 mm.
constexpr Spread acromion_lateral_mm{0.0, 3.0};
// The acromion lies above the head by 6.6 +- 1.2 mm (166 shoulders, J Orthop Surg Res 2020), the head by its
// own radius and the joint space beside the face; the mean acromion's lower side lies so high.
constexpr Spread acromiohumeral_mm{7.0, 1.0};
constexpr double mean_underside_mm = 33.0;
// Heads have radii of 24 +- 2 mm; a face is flatter than the head and its cartilage.
constexpr double head_radius_per_scale_mm = 25.0, least_mismatch_mm = 1.0;
// Coracoid beyond the rim 14.9 +- 6 mm (200 scapulae, Sapienza).
constexpr Spread coracoid_lateral_mm{1.0, 4.5}, coracoid_anterior_mm{1.0, 2.5};

// Holds the largest.
const Aabb whole_scapula_mm{{-62.0, -62.0, -132.0}, {118.0, 78.0, 60.0}};

}  // namespace

PhantomParams individual(uint64_t number) {
  const Person person(number);
  PhantomParams p;
  p.glenoid_height_mm = person.draw(Trait::height, height_mm);
  p.glenoid_width_mm = width_per_height * p.glenoid_height_mm + person.draw(Trait::width, beside_height_mm);
  p.version_rad = radians_from_degrees(person.draw(Trait::version, version_deg));
  p.inclination_rad = radians_from_degrees(person.draw(Trait::inclination, inclination_deg));
  p.plate_mm = person.draw(Trait::plate, plate_mm);
  p.shell_mm = person.draw(Trait::shell, shell_mm);
  p.joint_space_mm = person.draw(Trait::joint_space, joint_space_mm);
  AnatomicalSizes sizes;
  sizes.scale = mean_scale * (1.0 + scale_per_height * (p.glenoid_height_mm / height_mm.mean - 1.0) +
                              person.draw(Trait::size, scale_beside_height));
  sizes.acromion_lateral_mm = person.draw(Trait::acromion_out, acromion_lateral_mm);
  p.head_radius_mm = head_radius_per_scale_mm * sizes.scale;
  const double beside_face_mm = p.joint_space_mm + p.head_radius_mm;
  p.glenoid_radius_mm = std::max(person.draw(Trait::radius, radius_mm), beside_face_mm + least_mismatch_mm);
  // Superior inclination lifts the head; its tangent is near enough to the angle.
  const double top_of_head_mm = beside_face_mm * p.inclination_rad + p.head_radius_mm;
  sizes.acromion_superior_mm =
      (top_of_head_mm + person.draw(Trait::above_head, acromiohumeral_mm)) / sizes.scale - mean_underside_mm;
  sizes.coracoid_lateral_mm = person.draw(Trait::coracoid_out, coracoid_lateral_mm);
  sizes.coracoid_anterior_mm = person.draw(Trait::coracoid_front, coracoid_anterior_mm);
  sizes.body_bow_mm = person.draw(Trait::bow, body_bow_mm);
  p.anatomical = sizes;
  p.random_seed = number;
  p.field_mm = whole_scapula_mm;
  return p;
}

}  // namespace ream::ct
