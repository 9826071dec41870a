#include "reader/standard_terms.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/text.hpp"

namespace ream::reader {
namespace {

constexpr std::array terms = std::to_array<std::string_view>(
    {// Modalities.
     "AR", "ASMT", "AU", "BDUS", "BI", "BMD", "CR", "CT", "CTPROTOCOL", "DG", "DMS", "DOC", "DX", "ECG",
     "EEG", "EMG", "EOG", "EPS", "ES", "FID", "GM", "HC", "HD", "IO", "IOL", "IVOCT", "IVUS", "KER", "KO",
     "LEN", "LS", "M3D", "MG", "MR", "NM", "OAM", "OCT", "OP", "OPM", "OPT", "OPTBSV", "OPTENF", "OPV", "OSS",
     "OT", "PA", "PLAN", "POS", "PR", "PT", "PX", "REG", "RESP", "RF", "RG", "RTDOSE", "RTIMAGE", "RTINTENT",
     "RTPLAN", "RTRAD", "RTRECORD", "RTSEGANN", "RTSTRUCT", "RWV", "SEG", "SM", "SMR", "SR", "SRF", "STAIN",
     "TEXTUREMAP", "TG", "US", "VA", "XA", "XAPROTOCOL", "XC",
     // Kinds of values.
     "OD", "HU", "MGML", "Z_EFF", "ED", "EDW", "HU_MOD", "PCT",
     // Colours.
     "MONOCHROME1", "MONOCHROME2", "PALETTE COLOR", "RGB", "HSV", "ARGB", "CMYK", "YBR_FULL", "YBR_FULL_422",
     "YBR_PARTIAL_422", "YBR_PARTIAL_420", "YBR_ICT", "YBR_RCT", "XYB"});

constexpr std::array spellings = std::to_array<std::string_view>(
    {"hu", "hnsfu", "hounsfield", "hounsfieldunit", "hounsfieldunits", "houndsfield", "houndsfieldunit",
     "houndsfieldunits", "hounsefield", "hounsefieldunits", "hounsfeld"});

constexpr const char* unknown = "something else";

std::string letters_of(const std::string& text) {
  std::string letters = lower(text);
  std::erase_if(letters, [](char c) { return c < 'a' || c > 'z'; });
  return letters;
}

bool is_spelling(const std::string& letters) {
  return std::find(spellings.begin(), spellings.end(), letters) != spellings.end();
}

}  // namespace

std::string standard_term(const std::string& word) {
  return std::find(terms.begin(), terms.end(), word) != terms.end() ? word : unknown;
}

bool means_hu(const std::string& value_type) {
  const std::string letters = letters_of(value_type);
  const bool spelt_out = letters.starts_with("houn") && letters.find('f') != std::string::npos;
  return value_type != "HU" && (is_spelling(letters) || spelt_out);
}

std::string known_spelling_of_hu(const std::string& value_type) {
  constexpr std::string_view harmless = " []'().-_";
  const bool plain = std::all_of(value_type.begin(), value_type.end(), [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || harmless.find(c) != harmless.npos;
  });
  return plain && is_spelling(letters_of(value_type)) ? value_type : unknown;
}

}  // namespace ream::reader
