#pragma once
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <vector>

#include "ct/hu_volume.hpp"
#include "reader/dicom_file.hpp"

namespace ream::reader {

/// One picture of a DICOM file as its header describes it. World is LPS mm, as in DICOM.
struct DicomSlice {
  std::filesystem::path file;
  int frame = 0, frames = 1;                                  ///< of a file of many
  std::string series_uid, description, modality, value_type;  ///< value_type: RescaleType, "HU" in a CT
  std::string unusable;    ///< why it cannot be a slice of a volume; empty when it can
  bool localizer = false;  ///< a survey picture (ImageType)
  bool burnt_in = false;   ///< words are part of the picture (BurnedInAnnotation)
  int columns = 0, rows = 0;
  int bits_allocated = 16, bits_stored = 16;
  bool is_signed = false;
  Vec3 spacing_mm = Vec3::Ones();  ///< along the row, along the column, thickness (0: not said)
  Vec3 origin_mm = Vec3::Zero();   ///< centre of the first pixel
  Vec3 along_row = Vec3::UnitX(), along_column = Vec3::UnitY();
  double slope = 1.0, intercept = 0.0;        ///< HU = slope * stored + intercept
  std::optional<int> padding, padding_limit;  ///< stored values that mean nothing
  long number = 0;                            ///< InstanceNumber, or the frame
  ct::PatientNames patient;
  double position_mm = 0.0;  ///< along the normal; set when a stack is made

  Vec3 normal() const { return along_row.cross(along_column); }
  size_t pixels() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }
};

/// The pictures of a whole DICOM file, which parse_dicom took apart. Their claimed number of pixels is held
/// against what is there. Throws Error invalid_input naming the file when it claims more than it can hold.
std::vector<DicomSlice> describe_dicom(const std::filesystem::path& path, const DicomFile& file);

/// Reads pixels; keeps what the last packed file holds, so that the frames of one are unpacked once.
class DicomPixels {
 public:
  /// HU rounded to whole numbers; padding and what is below min_hu as min_hu, counted. Throws Error
  /// invalid_input naming the file.
  std::vector<int16_t> hu(const DicomSlice& slice);
  size_t outside() const { return outside_; }

 private:
  /// A frame's values as they are stored, in this machine's order.
  std::vector<char> plain(const DicomSlice& slice, const DicomFile& file) const;
  void unpack(const DicomSlice& slice, const DicomFile& file);

  std::filesystem::path unpacked_file_;
  std::vector<char> unpacked_;
  size_t outside_ = 0;
};

}  // namespace ream::reader
