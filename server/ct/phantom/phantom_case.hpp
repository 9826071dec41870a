#pragma once
#include "ct/phantom/phantom.hpp"

namespace ream::ct {

/// Parameters and upsampling of a phantom that a case is made of.
struct PhantomPreset {
  PhantomParams params;
  int upsample = 1;
};

/// `demo`: the glenoid and its vault at 0.2 mm, made in seconds. `thesis-5-4-2`: the bench case of the
/// thesis' section 5.4.2, CT voxels of 0.668 x 0.668 x 0.625 mm upsampled by 8 to 600 x 384 x 464, 12.7 M of
/// them filled. Throws Error not_found for another name.
PhantomPreset phantom_preset(const std::string& name);

/// In-memory phantom, then the pipeline of an import: segmented from a seed in the vault, upsampled, with the
/// glenoid frame of its ground truth and a plan straight through the face (default reamer, depth and pilot
/// hole). The pilot hole is not cut yet.
case_::Case make_phantom_case(const std::string& id, const PhantomParams& params, int upsample);

/// The case `demo` in <data_folder>/cases/demo, made on first use.
case_::Case load_or_make_demo_case(const std::filesystem::path& data_folder);

}  // namespace ream::ct
