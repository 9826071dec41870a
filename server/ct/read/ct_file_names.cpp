#include "ct/read/ct_file_names.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/text.hpp"

namespace ream::ct {
namespace {

struct Ending {
  std::string_view text;
  CtFileKind kind;
};

constexpr std::array<Ending, 16> endings = {{{".nrrd", CtFileKind::volume},
                                             {".nhdr", CtFileKind::volume},
                                             {".nii", CtFileKind::volume},
                                             {".nii.gz", CtFileKind::volume},
                                             {".mha", CtFileKind::volume},
                                             {".mhd", CtFileKind::volume},
                                             {".txt", CtFileKind::rows},
                                             {".csv", CtFileKind::rows},
                                             {".xyz", CtFileKind::rows},
                                             {".dcm", CtFileKind::dicom},
                                             {".zip", CtFileKind::archive},
                                             {".7z", CtFileKind::archive},
                                             {".rar", CtFileKind::archive},
                                             {".tar", CtFileKind::archive},
                                             {".tgz", CtFileKind::archive},
                                             {".tar.gz", CtFileKind::archive}}};

}  // namespace

CtFileKind kind_by_name(const std::filesystem::path& path) {
  const std::string name = lower(path.filename().string());
  const auto known =
      std::find_if(endings.begin(), endings.end(), [&](const Ending& e) { return name.ends_with(e.text); });
  return known == endings.end() ? CtFileKind::unknown : known->kind;
}

std::string ct_file_ending(const std::filesystem::path& path) {
  const std::string name = lower(path.filename().string());
  return name.ends_with(".nii.gz") ? ".nii.gz" : std::filesystem::path(name).extension().string();
}

bool names_another_file(const std::filesystem::path& path) {
  const std::string ending = ct_file_ending(path);
  return ending == ".nhdr" || ending == ".mhd";
}

}  // namespace ream::ct
