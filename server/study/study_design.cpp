#include "study/study_design.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "study/seeded_draws.hpp"

namespace ream::study {
using nlohmann::json;
namespace {

constexpr std::array phase_names = {"pre", "training", "post", "retention"};

/// An arm comes once to so often in a block of the random sequence.
constexpr uint64_t max_repeats = 3;

StudyArm arm_from(const json& value) {
  return {value.at("id"),
          value.at("name"),
          value.at("training_sessions"),
          value.value("theatre", false),
          value.value("script", ""),
          value.value("device_profile", "")};
}

json to_json(const StudyArm& arm) {
  return {{"id", arm.id},           {"name", arm.name},     {"training_sessions", arm.training_sessions},
          {"theatre", arm.theatre}, {"script", arm.script}, {"device_profile", arm.device_profile}};
}

int session_count(const StudyDesign& design, const StudyArm& arm, Phase phase) {
  switch (phase) {
    case Phase::pre: return design.pre_sessions;
    case Phase::training: return arm.training_sessions;
    case Phase::post: return design.post_sessions;
    case Phase::retention: return design.retention_sessions;
  }
  return 0;
}

}  // namespace

const char* to_text(Phase phase) { return phase_names[static_cast<size_t>(phase)]; }

std::optional<Phase> phase_from(std::string_view text) {
  const auto found = std::find(phase_names.begin(), phase_names.end(), text);
  if (found == phase_names.end()) return std::nullopt;
  return static_cast<Phase>(found - phase_names.begin());
}

json to_json(const StudyDesign& design) {
  json arms = json::array();
  for (const StudyArm& arm : design.arms) arms.push_back(to_json(arm));
  return {{"arms", std::move(arms)},
          {"pre_sessions", design.pre_sessions},
          {"post_sessions", design.post_sessions},
          {"retention_sessions", design.retention_sessions},
          {"retention_after_days", design.retention_after_days},
          {"test_case", design.test_case},
          {"test_theatre", design.test_theatre}};
}

StudyDesign design_from(const json& value) {
  StudyDesign design;
  std::set<std::string> ids;
  for (const json& arm : value.at("arms")) {
    design.arms.push_back(arm_from(arm));
    if (!ids.insert(design.arms.back().id).second)
      throw Error(ErrorKind::invalid_input,
                  "design.arms: id '" + design.arms.back().id + "' is that of another arm too");
  }
  design.pre_sessions = value.value("pre_sessions", design.pre_sessions);
  design.post_sessions = value.value("post_sessions", design.post_sessions);
  design.retention_sessions = value.value("retention_sessions", design.retention_sessions);
  design.retention_after_days = value.value("retention_after_days", design.retention_after_days);
  design.test_case = value.value("test_case", "");
  design.test_theatre = value.value("test_theatre", false);
  return design;
}

const StudyArm* find_arm(const StudyDesign& design, const std::string& id) {
  const auto found =
      std::find_if(design.arms.begin(), design.arms.end(), [&](const StudyArm& arm) { return arm.id == id; });
  return found == design.arms.end() ? nullptr : &*found;
}

const StudyArm& arm_at(const StudyDesign& design, const std::string& seed, const std::string& stratum,
                       int64_t place) {
  SeededDraws draws(hash_text(stratum, hash_text(seed)));
  for (int64_t begin = 0;;) {
    std::vector<size_t> block(design.arms.size() * (1 + draws.below(max_repeats)));
    for (size_t i = 0; i < block.size(); ++i) block[i] = i % design.arms.size();
    draws.shuffle(block);
    const auto end = begin + static_cast<int64_t>(block.size());
    if (place < end) return design.arms[block[static_cast<size_t>(place - begin)]];
    begin = end;
  }
}

std::optional<NextSession> next_session(const StudyDesign& design, const StudyArm& arm,
                                        const std::vector<DoneSession>& done) {
  for (const Phase phase : {Phase::pre, Phase::training, Phase::post, Phase::retention}) {
    const int wanted = session_count(design, arm, phase);
    const auto had = static_cast<int>(std::count_if(
        done.begin(), done.end(), [&](const DoneSession& session) { return session.phase == phase; }));
    if (had >= wanted) continue;
    NextSession next{phase, had + 1, wanted, 0};
    if (phase == Phase::retention)
      for (const DoneSession& session : done)
        if (session.phase && session.phase != Phase::retention)
          next.not_before_day = std::max(next.not_before_day, session.day + design.retention_after_days);
    return next;
  }
  return std::nullopt;
}

}  // namespace ream::study
