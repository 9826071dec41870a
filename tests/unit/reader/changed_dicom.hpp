#pragma once
#include <gdcmDataSet.h>
#include <gdcmTransferSyntax.h>

#include <filesystem>
#include <functional>
#include <string>

#include "ct/hu_volume.hpp"

namespace ream::test {

/// Reads a DICOM file whole, lets `change` work on its data set, and writes it back.
void change_dicom(const std::filesystem::path& file, const std::function<void(gdcm::DataSet&)>& change);

/// Puts text (also numbers as decimal strings) or a 16-bit number into a data set.
void put_text(gdcm::DataSet& set, uint16_t group, uint16_t element, const std::string& text);
void put_number(gdcm::DataSet& set, uint16_t group, uint16_t element, int number);

/// put_text in a file.
void set_text(const std::filesystem::path& file, uint16_t group, uint16_t element, const std::string& text);

/// Packs or unpacks the pixels, and writes the file in that transfer syntax.
void transcode(const std::filesystem::path& file, gdcm::TransferSyntax::TSType syntax);

/// slice_0001.dcm and so on, as write_dicom_folder names them.
std::filesystem::path slice_file(const std::filesystem::path& folder, int number);

/// One enhanced CT file of all slices, each frame with position and rescale slope (1 + its number) of its
/// own, so that the HU read back are those of `volume`, whose HU must be divisible by every slope.
void write_enhanced(const ct::HuVolume& volume, const std::filesystem::path& file);

bool mentions(const ct::HuVolume& volume, const std::string& words);

}  // namespace ream::test
