#pragma once
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "case/landmarks.hpp"
#include "case/planning.hpp"
#include "ct/build/ct_workspace.hpp"
#include "jobs/job_service.hpp"
#include "net/message.hpp"
#include "score/plan_outcome.hpp"
#include "session/service/session_service.hpp"
#include "workup/ct_cache.hpp"
#include "workup/upload_store.hpp"

namespace ream::workup {

/// A case that is to be made of an upload.
struct NewCase {
  std::string upload_id, id, name, series_uid;  ///< id empty: made of the file's name
  case_::Side side = case_::Side::right;
};

/// What is done with cases between upload and session: import, segmentation, landmarks, plan, build, each
/// kept in the case's folder. Thread-safe. Unknown cases throw Error not_found, steps that miss an earlier
/// one conflict.
class CaseService {
 public:
  /// `jobs` does the long work; it is shut down before this goes. `sessions` outlives it.
  CaseService(std::filesystem::path cases_folder, const session::SessionService& sessions,
              jobs::JobService& jobs);

  std::filesystem::path folder_of(const std::string& id) const;
  ct::Workup workup(const std::string& id) const;

  jobs::JobRecord import(const NewCase& wanted, UploadStore& uploads);
  jobs::JobRecord copy(const std::string& from, case_::Side side);
  jobs::JobRecord segment(const std::string& id, ct::SegmentationSettings settings);
  jobs::JobRecord build(const std::string& id, const ct::BuildSettings& settings);
  void undo_segmentation(const std::string& id);
  /// Error conflict while there is work on it or sessions belong to it.
  void remove(const std::string& id);

  case_::Side side_of(const std::string& id) const;
  case_::Landmarks landmarks(const std::string& id) const;
  void set_landmarks(const std::string& id, const case_::Landmarks& landmarks);
  case_::Plan propose(const std::string& id, const case_::PlanTargets& targets);
  case_::PlanAssessment assess(const std::string& id, const case_::Plan& plan);
  /// What the plan reaches with a reamer of that shape: of the bone that sessions begin with, where it was
  /// built of what is segmented now, else of what is segmented.
  score::MetricResults outcome(const std::string& id, const case_::Plan& plan, shell::ToolProfile reamer);
  /// Error conflict with the reason when the plan needs an override.
  case_::PlanAssessment set_plan(const std::string& id, const case_::Plan& plan);

  /// One slice (0 u, 1 v, 2 w) as 16-bit HU or as labels, little endian. Error not_found outside the volume;
  /// conflict when labels are of another revision than the one asked for.
  net::Bytes slice(const std::string& id, int axis, int index, bool of_labels,
                   std::optional<int> revision = std::nullopt);
  /// Writes the CT as it was imported, by the file's extension. Error conflict when the case has none.
  void write_volume(const std::string& id, const std::filesystem::path& file);
  /// The surface of the case, LPS mm, binary PLY.
  std::string mesh(const std::string& id);
  /// What lies around the bone that is reamed, LPS mm, binary PLY, for pictures. Error not_found when there
  /// is nothing.
  std::string surroundings(const std::string& id);

 private:
  std::string unused_id(const std::string& wanted) const;
  void require_no_sessions(const std::string& id, const std::string& what) const;
  CtCache::Bone surface_of(const std::string& id);
  std::optional<case_::GlenoidFrame> built_glenoid(const std::string& id) const;

  const std::filesystem::path cases_folder_;
  const session::SessionService& sessions_;
  CtCache cache_;
  std::mutex changing_;  ///< one writer of a case's small files at a time
  jobs::JobService& jobs_;
};

}  // namespace ream::workup
