#pragma once
#include <cstdint>

#include "ct/phantom/phantom.hpp"

namespace ream::ct {

/// The anatomical shoulder of one of many people: sizes and angles drawn so that fifty of them measure as
/// published series do (individual.cpp says what is a series' and what is chosen), the larger scapula with
/// the larger glenoid. The same number draws the same person everywhere.
PhantomParams individual(uint64_t number);

}  // namespace ream::ct
