#include "reader/ct_source.hpp"

#include <algorithm>
#include <fstream>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "ct/read/ct_file_names.hpp"
#include "reader/ct_files.hpp"
#include "store/zip_archive.hpp"

namespace ream::reader {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t max_entries = 20000;
constexpr uint64_t max_unpacked_bytes = uint64_t{8} << 30, always_unpacked_bytes = uint64_t{64} << 20;
constexpr uint64_t max_archive_packing = 200;          // slices pack to a third, label maps to a hundredth
constexpr uint64_t spare_bytes = uint64_t{256} << 20;  // left free on the disk

bool is_zip(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) return false;
  if (ct::ct_file_ending(path) == ".zip") return true;
  std::ifstream in(path, std::ios::binary);
  std::string start(4, '\0');
  in.read(start.data(), 4);
  return start == std::string("PK\3\4", 4);
}

store::UnpackLimits limits_for(const fs::path& zip, const fs::path& scratch) {
  store::UnpackLimits limits;
  limits.entries = max_entries;
  limits.bytes =
      std::min(max_unpacked_bytes, max_archive_packing * fs::file_size(zip) + always_unpacked_bytes);
  limits.durable = false;
  std::error_code failed;
  const auto space = fs::space(scratch, failed);
  if (!failed)
    limits.bytes =
        std::min<uint64_t>(limits.bytes, space.available > spare_bytes ? space.available - spare_bytes : 0);
  return limits;
}

struct FoundFiles {
  std::vector<fs::path> volumes, texts;
  bool dicom = false;
};

/// What other systems add to archives is passed over: __MACOSX, ._name, .DS_Store.
FoundFiles contents_of(const fs::path& folder, const fs::path& zip) {
  FoundFiles contents;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string name = lower(entry->path().filename().string());
    if (entry->is_directory() && (name == "__macosx" || name.starts_with('.')))
      entry.disable_recursion_pending();
    if (!entry->is_regular_file() || name.starts_with('.')) continue;
    const ct::CtFileKind kind = ct::kind_by_name(entry->path());
    if (kind == ct::CtFileKind::archive || is_zip(entry->path()))
      throw Error(ErrorKind::invalid_input,
                  zip.string() + " holds another archive; unpack that one and zip the CT itself");
    if (kind == ct::CtFileKind::volume)
      contents.volumes.push_back(entry->path());
    else if (kind == ct::CtFileKind::rows)
      contents.texts.push_back(entry->path());
    else if (!contents.dicom)
      contents.dicom = kind == ct::CtFileKind::dicom || is_dicom(entry->path());
  }
  return contents;
}

fs::path ct_in(const fs::path& folder, const fs::path& zip) {
  const FoundFiles contents = contents_of(folder, zip);
  const auto refuse = [&](const std::string& why) {
    return Error(ErrorKind::invalid_input, zip.string() + " holds " + why);
  };
  if (contents.dicom && !contents.volumes.empty())
    throw refuse("DICOM slices and volume files; zip one of them only");
  if (contents.volumes.size() > 1)
    throw refuse(std::to_string(contents.volumes.size()) + " volume files; zip one of them only");
  if (contents.dicom) return folder;
  if (!contents.volumes.empty()) return contents.volumes.front();
  if (contents.texts.size() == 1) return contents.texts.front();
  throw refuse("no CT; zip DICOM slices, or one .nrrd, .nii, .nii.gz, .mha or .txt (rows x y z gray) file");
}

}  // namespace

CtSource::CtSource(const fs::path& path, const Progress& progress, const fs::path& scratch)
    : given_(path), path_(path) {
  if (!is_zip(path)) return;
  unpacked_ = std::make_unique<TemporaryFolder>(scratch / "ream-ct");
  store::unpack_zip(path, unpacked_->path(), limits_for(path, scratch), progress);
  path_ = ct_in(unpacked_->path(), path);
}

std::string CtSource::without_scratch(std::string message) const {
  if (!unpacked_) return message;
  const std::string folder = unpacked_->path().string();
  for (size_t at = 0; (at = message.find(folder, at)) != std::string::npos;)
    message.replace(at, folder.size(), given_.string());
  return message;
}

}  // namespace ream::reader
