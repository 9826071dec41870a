#pragma once
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "reader/dicom_slice.hpp"

namespace ream::reader {

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

/// Reads the pixels of a stack onto its even, orthogonal grid: each slice shifted in its plane (bilinear, air
/// outside) when the stack is sheared, then linear between neighbours where the grid has no slice of its own.
/// Holds two slices besides the volume, which may take `max_bytes`. Fills dims, spacing, pose, hu and the
/// warning about padding. Errors: invalid_input naming the file or `place`; cancelled.
void load_stack(ct::HuVolume& volume, const SliceStack& stack, const std::string& place, uint64_t max_bytes,
                const Progress& progress);

}  // namespace ream::reader
