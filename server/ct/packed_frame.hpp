#pragma once
#include <string>
#include <string_view>

namespace ream::ct {

/// What keeps a packed picture (JPEG, JPEG-LS, JPEG 2000; or RLE when `rle`) from being one of a single value
/// a pixel, that many columns and rows, and whole; empty when nothing does. Read from the stream's own
/// headers (ITU-T T.81, T.87, T.800; DICOM PS3.5 annex G), because the library ends the program, or fills up
/// with what it likes, where they contradict what DICOM says.
std::string packed_frame_problem(std::string_view bytes, int columns, int rows, int bytes_a_value, bool rle);

}  // namespace ream::ct
