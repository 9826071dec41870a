#pragma once
#include "core/progress.hpp"
#include "ct/slice_stack.hpp"

namespace ream::ct {

/// Reads the pixels of a stack onto its even, orthogonal grid: each slice shifted in its plane (bilinear, air
/// outside) when the stack is sheared, then linear between neighbours where the grid has no slice of its own.
/// Holds two slices besides the volume. Fills dims, spacing, pose, hu and the warning about padding. Errors:
/// invalid_input naming the file or `place`; cancelled.
void load_stack(HuVolume& volume, const SliceStack& stack, const std::string& place,
                const Progress& progress);

}  // namespace ream::ct
