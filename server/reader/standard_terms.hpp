#pragma once
#include <string>

namespace ream::reader {

/// The word, if it is one of DICOM's own for modalities (PS3.3 C.7.3.1.1.1), kinds of values (RescaleType,
/// C.11.1.1.2) or photometric interpretations (C.7.6.3.1.2); else "something else": what a scanner or a clerk
/// has written there may be of a person.
std::string standard_term(const std::string& word);

/// A known spelling of Hounsfield units other than "HU": "hu", "Houndsfield Unit", "[hnsf'U]".
bool means_hu(const std::string& value_type);
/// That spelling, or "something else".
std::string known_spelling_of_hu(const std::string& value_type);

}  // namespace ream::reader
