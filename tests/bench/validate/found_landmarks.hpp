#pragma once
#include <cstdint>

#include "bench/validate/scanned_glenoid.hpp"
#include "case/landmarks.hpp"

namespace ream::bench {

/// Somebody who places landmarks on surfaces that came out of a CT: looks straight at the glenoid's face and
/// clicks on its rim, looks at the blade from the flat side and clicks on its tips.
struct Observer {
  double view_error_deg = 5.0;  ///< greatest angle of every view from straight
  double click_error_mm = 0.0;  ///< standard deviation in two directions across the face
  uint64_t seed = 1;
};

/// The scapula as CT shows it: the vault of a glenoid, and the medial and inferior tips of its blade, a
/// triangle 4 mm thick with rounded corners at trigonum and inferior angle. What is scanned of each is a part
/// of one CT.
struct ScannedScapula {
  test::AnalyticGlenoid glenoid;
  ScanProtocol protocol;
  uint64_t seed = 1;
};

/// Landmarks on what is imported of those scans: glenoid centre, four points of the rim, trigonum and
/// inferior angle. Of the formulas it takes no more than where and how to look, with the observer's errors.
/// Errors: those of ct::import_ct, and invalid_input where the surface has no rim.
struct ImportedScapula {
  voxel::BoneModel vault, trigonum, inferior_angle;
};
ImportedScapula imported_scapula(const ScannedScapula& scanned);
case_::Landmarks found_landmarks(const ScannedScapula& scanned, const ImportedScapula& imported,
                                 const Observer& observer);

}  // namespace ream::bench
