#pragma once
#include <string>
#include <vector>

#include "ct/dicom_slice.hpp"

namespace ream::ct {

/// Slices of one orientation and size, sorted along their normal, and the even grid that they go onto.
struct SliceStack {
  std::vector<DicomSlice> slices;  ///< position_mm is set
  double distance_mm = 1.0;        ///< of the grid's slices, the first of which lies at the first position
  int count = 0;                   ///< of the grid's slices
  bool even = true;                ///< every slice lies on the grid
  bool sheared = false;            ///< slices are shifted in their plane against the first
  std::vector<std::string> warnings;
};

/// The stack within one series. `place` names the folder in errors. Throws Error invalid_input when fewer
/// than two slices fit together, or when slices are missing over a gap too wide to interpolate.
SliceStack stack_of(const std::vector<DicomSlice>& series, const std::string& place);

}  // namespace ream::ct
