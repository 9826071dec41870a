#pragma once
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "case/case.hpp"
#include "case/landmarks.hpp"
#include "geometry/triangle_mesh.hpp"
#include "record/recording.hpp"

namespace ream::session {

/// Loads cases so that those of one folder share their densities in memory, as long as any of them lives: a
/// further session on a case costs its coverage only. Thread-safe.
class CaseCache {
 public:
  /// As case_::load_case.
  case_::Case load(const std::filesystem::path& folder);

 private:
  struct Known {
    std::filesystem::file_time_type written;  ///< of density.zst
    voxel::WatchedBytes density;
  };
  voxel::SharedBytes density_of(const std::string& key, std::filesystem::file_time_type written);

  std::mutex mutex_;
  std::map<std::string, Known> known_;
};

/// The case that a name means: `demo`, which is made on first use, an id in the data folder, or the path of a
/// case folder. Errors: those of load_case.
case_::Case find_case(const std::string& name, const std::filesystem::path& data);

/// Where the case of that name is, or would be.
std::filesystem::path case_folder_of(const std::string& name, const std::filesystem::path& data);

/// What lies around the bone of the case of that name, as ct::kept_surroundings().
TriangleMesh case_surroundings(const std::string& name, const std::filesystem::path& data);

/// Its side, landmarks and glenoid frame as they are now. Error invalid_input for its landmarks.
case_::Anatomy find_anatomy(const case_::Case& c, const std::string& name, const std::filesystem::path& data);

/// The case_as_recorded() that a recording began with. `case_name` as for find_case(), or empty for the case
/// that the header names. Errors: not_found; invalid_input for a recording of a revision that says too little
/// to be computed again; those of case_as_recorded().
case_::Case recorded_case(const record::Recording& recording, const std::string& case_name,
                          const std::filesystem::path& data);

/// What a recording's session is measured against; recordings of older revisions do not say it, so that it is
/// what `native`, their case, says now. `case_name` as above. Error invalid_input.
case_::Anatomy recorded_anatomy(const record::Recording& recording, const case_::Case& native,
                                const std::string& case_name, const std::filesystem::path& data);

}  // namespace ream::session
