#include "unit/reader/changed_dicom.hpp"

#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#include <gdcmReader.h>
#include <gdcmSequenceOfItems.h>
#include <gdcmWriter.h>

#include <cstdio>
#include <stdexcept>

#include "ct/read/write_volume.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {
namespace fs = std::filesystem;

void change_dicom(const fs::path& file, const std::function<void(gdcm::DataSet&)>& change) {
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  if (!reader.Read()) throw std::runtime_error("cannot read " + file.string());
  change(reader.GetFile().GetDataSet());
  gdcm::Writer writer;
  writer.SetFile(reader.GetFile());
  writer.SetCheckFileMetaInformation(false);
  const fs::path written = file.string() + ".new";
  writer.SetFileName(written.c_str());
  if (!writer.Write()) throw std::runtime_error("cannot write " + file.string());
  fs::rename(written, file);
}

void put_text(gdcm::DataSet& set, uint16_t group, uint16_t element, const std::string& text) {
  const std::string even = text.size() % 2 == 0 ? text : text + " ";
  gdcm::DataElement e(gdcm::Tag(group, element), 0, gdcm::VR::LO);
  e.SetByteValue(even.data(), static_cast<uint32_t>(even.size()));
  set.Replace(e);
}

void put_number(gdcm::DataSet& set, uint16_t group, uint16_t element, int number) {
  const char bytes[2] = {static_cast<char>(number & 0xff), static_cast<char>((number >> 8) & 0xff)};
  gdcm::DataElement e(gdcm::Tag(group, element), 0, gdcm::VR::US);
  e.SetByteValue(bytes, 2);
  set.Replace(e);
}

void set_text(const fs::path& file, uint16_t group, uint16_t element, const std::string& text) {
  change_dicom(file, [&](gdcm::DataSet& set) { put_text(set, group, element, text); });
}

void transcode(const fs::path& file, gdcm::TransferSyntax::TSType syntax) {
  gdcm::ImageReader reader;
  reader.SetFileName(file.c_str());
  if (!reader.Read()) throw std::runtime_error("cannot read " + file.string());
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(syntax);
  change.SetInput(reader.GetImage());
  if (!change.Change()) throw std::runtime_error("cannot transcode " + file.string());
  gdcm::ImageWriter writer;
  writer.SetFile(reader.GetFile());
  writer.SetImage(change.GetOutput());
  const fs::path written = file.string() + ".new";
  writer.SetFileName(written.c_str());
  if (!writer.Write()) throw std::runtime_error("cannot write " + file.string());
  fs::rename(written, file);
}

fs::path slice_file(const fs::path& folder, int number) {
  char name[32];
  std::snprintf(name, sizeof name, "slice_%04d.dcm", number);
  return folder / name;
}

bool mentions(const ct::HuVolume& volume, const std::string& words) {
  for (const auto& warning : volume.warnings)
    if (warning.find(words) != std::string::npos) return true;
  return false;
}

namespace {

/// An element that holds one item with these texts.
void put_macro(gdcm::DataSet& set, uint16_t group, uint16_t element,
               std::initializer_list<std::tuple<uint16_t, uint16_t, std::string>> texts) {
  gdcm::Item item;
  item.SetVLToUndefined();
  for (const auto& [g, e, text] : texts) put_text(item.GetNestedDataSet(), g, e, text);
  gdcm::SmartPointer<gdcm::SequenceOfItems> items = new gdcm::SequenceOfItems;
  items->SetLengthToUndefined();
  items->AddItem(item);
  gdcm::DataElement sequence(gdcm::Tag(group, element), 0, gdcm::VR::SQ);
  sequence.SetValue(*items);
  sequence.SetVLToUndefined();
  set.Replace(sequence);
}

std::string text_of(const Vec3& v) {
  return std::to_string(v.x()) + "\\" + std::to_string(v.y()) + "\\" + std::to_string(v.z());
}

}  // namespace

void write_enhanced(const ct::HuVolume& volume, const fs::path& file) {
  const TemporaryFolder folder;
  write_dicom_folder(volume, folder.path(), 7);
  const size_t pixels = volume.voxel_count() / static_cast<size_t>(volume.dims.z());
  std::vector<int16_t> stored = volume.hu;
  for (size_t i = 0; i < stored.size(); ++i)
    stored[i] = static_cast<int16_t>(stored[i] / (1 + static_cast<int>(i / pixels)));
  fs::copy_file(slice_file(folder.path(), 1), file);
  change_dicom(file, [&](gdcm::DataSet& set) {
    put_text(set, 0x0008, 0x0016, "1.2.840.10008.5.1.4.1.1.2.1");
    put_text(set, 0x0028, 0x0008, std::to_string(volume.dims.z()));
    for (const auto& [group, element] :
         {std::pair{0x0020, 0x0032}, {0x0020, 0x0037}, {0x0028, 0x0030}, {0x0028, 0x1052}, {0x0028, 0x1053}})
      set.Remove(gdcm::Tag(static_cast<uint16_t>(group), static_cast<uint16_t>(element)));
    gdcm::SmartPointer<gdcm::SequenceOfItems> frames = new gdcm::SequenceOfItems;
    frames->SetLengthToUndefined();
    for (int w = 0; w < volume.dims.z(); ++w) {
      gdcm::Item frame;
      frame.SetVLToUndefined();
      put_macro(frame.GetNestedDataSet(), 0x0020, 0x9113,
                {{0x0020, 0x0032, text_of(volume.world_of_centre({0, 0, w}))}});
      put_macro(frame.GetNestedDataSet(), 0x0028, 0x9145,
                {{0x0028, 0x1052, "0"}, {0x0028, 0x1053, std::to_string(1 + w)}, {0x0028, 0x1054, "HU"}});
      frames->AddItem(frame);
    }
    gdcm::DataElement own(gdcm::Tag(0x5200, 0x9230), 0, gdcm::VR::SQ);
    own.SetValue(*frames);
    own.SetVLToUndefined();
    set.Replace(own);
    gdcm::DataSet shared;
    const Mat3& r = volume.world_from_volume.rotation;
    put_macro(shared, 0x0020, 0x9116, {{0x0020, 0x0037, text_of(r.col(0)) + "\\" + text_of(r.col(1))}});
    put_macro(shared, 0x0028, 0x9110,
              {{0x0028, 0x0030,
                std::to_string(volume.spacing_mm.y()) + "\\" + std::to_string(volume.spacing_mm.x())},
               {0x0018, 0x0050, std::to_string(volume.spacing_mm.z())}});
    gdcm::Item item;
    item.SetVLToUndefined();
    item.SetNestedDataSet(shared);
    gdcm::SmartPointer<gdcm::SequenceOfItems> items = new gdcm::SequenceOfItems;
    items->SetLengthToUndefined();
    items->AddItem(item);
    gdcm::DataElement common(gdcm::Tag(0x5200, 0x9229), 0, gdcm::VR::SQ);
    common.SetValue(*items);
    common.SetVLToUndefined();
    set.Replace(common);
    gdcm::DataElement all(gdcm::Tag(0x7fe0, 0x0010), 0, gdcm::VR::OW);
    all.SetByteValue(reinterpret_cast<const char*>(stored.data()), static_cast<uint32_t>(2 * stored.size()));
    set.Replace(all);
  });
}

}  // namespace ream::test
