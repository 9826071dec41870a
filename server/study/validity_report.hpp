#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ream::study {

/// A session of a participant, with what was measured in it.
struct RatedSession {
  std::string session, participant;
  std::string experience;                  ///< "novice", "intermediate", "expert"; empty: not known
  std::string arm;                         ///< of a trial; empty: none
  std::string phase;                       ///< "pre", "training", "post", "retention"; empty: none
  std::map<std::string, double> measures;  ///< by name; what is not finite is missing
  int attempt = 0;                         ///< the participant's first is 1; 0: not known
};

/// `scale`: 1 to 5; the sum of all that anybody rated is a rater's total. `check`: 0 or 1.
enum class ItemKind { scale, check };

struct RatedItem {
  std::string id;
  ItemKind kind = ItemKind::scale;
};

struct Rating {
  std::string rater, session, item;
  double value = 0.0;
};

struct ValidityInput {
  std::vector<RatedSession> sessions;
  std::vector<RatedItem> items;
  std::vector<Rating> ratings;
  uint64_t bootstrap_seed = 1;
  size_t bootstrap_samples = 2000;
};

/// The name that the mean of the raters' totals has among the measures.
inline const std::string raters_total = "raters_total";

/// Groups, arms and tables of persons that are smaller than this give no numbers.
inline constexpr size_t min_persons = 3;

/// Numbers of one measure (or item) by name, and sentences about those that are missing.
struct ValidityLine {
  std::string subject;  ///< "A:post", "A-B:post", where a measure has more than one line; else empty
  std::string measure;
  std::vector<std::pair<std::string, double>> values;
  std::vector<std::string> notes;
};

/// Whether scores mean anything. Each participant counts once in whatever is said of persons: with the mean
/// of the sessions that are asked for; learning is of the means of attempts. docs/validity.md says what each
/// number means.
struct ValidityReport {
  std::vector<ValidityLine> agreement;        ///< raters on each scale item and on the total (ICC)
  std::vector<ValidityLine> checklist;        ///< raters on each checklist item (kappa)
  std::vector<ValidityLine> known_groups;     ///< experts less novices
  std::vector<ValidityLine> correlations;     ///< of each measure with the raters' total
  std::vector<ValidityLine> changes;          ///< from pre to post and to retention, by arm
  std::vector<ValidityLine> arm_differences;  ///< of these changes, for each two arms
  std::vector<ValidityLine> benchmarks;       ///< what experts reach
  std::vector<ValidityLine> learning;         ///< curves over attempts, without experts and tests
  std::vector<std::string> notes;             ///< why whole parts are missing
};

/// Pure: equal inputs give equal bits. Error invalid_input, naming the thing: a session or a rating twice, a
/// rating of a session or item that is not there or with a value outside its scale, a participant of two
/// experiences or arms, an unknown experience or phase, a measure that is called as the raters' total.
ValidityReport validity_report(const ValidityInput& input);

/// {"agreement": [{"subject", "measure", "values": {name: number}, "notes": [...]}], ..., "notes": [...]}
nlohmann::json validity_json(const ValidityReport& report);

/// Names and lines of the parts, in the order of the report.
using ValidityPart = std::pair<const char*, const std::vector<ValidityLine>*>;
std::array<ValidityPart, 8> parts_of(const ValidityReport& report);

}  // namespace ream::study
