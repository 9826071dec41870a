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

/// Two plates that look alike and differ in their layers, and which of them a question asks for, by a forced
/// choice. Layers from the surface down; the last one goes on to the bottom. Strelzow, Kusins, Ferreira &
/// LeBel (JBJS Open Access 2023, PMC10292736) let surgeons tell cartilage and its change to bone by
/// vibration, without a choice between two.
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

/// What everybody may know of their ids.
inline constexpr const char* two_plates_word = "two-plates";

/// Whether a case is one of those, by its id.
bool is_two_plates(std::string_view case_id);

/// The case of that id: two round plates of 38.6 mm side by side, one above the other, each hollow as the
/// thesis' reamer is, so that all of the reamer meets a layer at once. Rims, walls and what joins the plates
/// are of one soft bone, so that only the hollows tell them apart. Not by way of a CT: layers are as thick as
/// they are said to be, to half a voxel of 0.3 mm. Lateral is towards the hand, superior up; the plan's axis
/// is between the plates. Error not_found for another id.
Case make_two_plates(const std::string& case_id);

/// Where that case is kept: beside the data folder's cases, so that nobody lists, plans or imports it.
std::filesystem::path two_plates_folder(const std::filesystem::path& data_folder, const std::string& case_id);
/// Makes it there unless it is there.
void keep_two_plates(const std::filesystem::path& data_folder, const std::string& case_id);

}  // namespace ream::case_
