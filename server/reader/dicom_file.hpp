#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace ream::reader {

enum class DicomState {
  not_dicom,  ///< no DICOM marker, and no bare data set either
  no_pixels,  ///< whole, but without an image
  whole,      ///< everything up to and with the pixel data is there
  damaged,    ///< cut short (an element goes on behind the end of the file), or not as the standard has it
};

/// Data elements by tag (group << 16 | element): those that CT slices need, as their bytes, 16-bit numbers in
/// little-endian order.
struct DicomSet {
  std::map<uint32_t, std::string> values;
  std::map<uint32_t, std::vector<DicomSet>> sequences;
};

/// A DICOM file taken apart, but for its pixels.
struct DicomFile {
  DicomState state = DicomState::not_dicom;
  std::string transfer_syntax;  ///< UID
  bool big_endian = false;
  DicomSet set;
  struct Piece {
    uint64_t at = 0, bytes = 0;
  };
  bool packed = false;
  std::vector<Piece>
      pixels;            ///< where they lie: one piece; of packed ones the offset table, then the fragments
  std::string inflated;  ///< of a deflated file: what the pieces are places of, instead of the file

  /// Throws Error invalid_input when they are not there any more.
  std::string bytes_at(const std::filesystem::path& file, const Piece& piece) const;
};

/// Takes a file apart (DICOM PS3.5 and PS3.10; implicit and explicit, little and big endian, deflated; also
/// old files without a preamble). Every length is held against the file's. Done here, not by the library that
/// unpacks pixels, because that one ends the program on some damaged headers and takes missing pixels for
/// zeros.
DicomFile parse_dicom(const std::filesystem::path& file);

}  // namespace ream::reader
