#pragma once
#include <cstdint>

#include "ct/phantom/phantom.hpp"

namespace ream::ct {

/// The anatomical shoulder of one of many people: sizes and angles drawn from published means and spreads
/// (individual.cpp names each), the larger scapula with the larger glenoid. The same number draws the same
/// person everywhere.
PhantomParams individual(uint64_t number);

}  // namespace ream::ct
