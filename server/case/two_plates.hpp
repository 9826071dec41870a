#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"

namespace ream::case_ {

/// What is met below a plate's surface. `code` as BoneModel::density has it.
struct PlateLayer {
  double thickness_mm = 0.0;
  uint8_t code = 0;
};

/// Two plates that look alike and differ in their layers, and which of them a question asks for: a forced
/// choice between two, as surgeons told cartilage from bone in Strelzow, Kusins, Ferreira & LeBel (JBJS Open
/// Access 2023, PMC10292736). Layers from the surface down; the last one goes on to the bottom.
struct PlateComparison {
  std::string id;        ///< [a-z][a-z_]*, stable: exports name it
  std::string question;  ///< "Which plate begins with cartilage?"
  std::vector<PlateLayer> asked_for, other;
};

/// Those that come with the program.
const std::vector<PlateComparison>& plate_comparisons();
/// None for an id that there is not.
const PlateComparison* find_plate_comparison(std::string_view id);

/// Id of the case of a comparison whose plate that is asked for is the upper one, or the lower. Says neither:
/// "two-plates-3fa2c1d0". Error not_found for an unknown comparison.
std::string two_plates_id(std::string_view comparison, bool asked_for_is_upper);

/// Whether a case is one of those, by its id.
bool is_two_plates(std::string_view case_id);

/// The case of that id: two round plates, 42 mm wide and 46 mm apart, each hollow as the thesis' reamer is,
/// so that all of the reamer meets a layer at once. Not by way of a CT: layers are as thick as they are said
/// to be, to a voxel of 0.3 mm. Lateral is towards the hand, superior up; the plan's axis meets the upper
/// plate. Error not_found for another id.
Case make_two_plates(const std::string& case_id);

/// The same in <data_folder>/cases, made on first use.
Case load_or_make_two_plates(const std::filesystem::path& data_folder, const std::string& case_id);

}  // namespace ream::case_
