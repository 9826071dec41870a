#pragma once
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "net/message.hpp"
#include "store/rating_table.hpp"
#include "study/study_service.hpp"

namespace ream::study {

/// Somebody who rates, and how far they are.
struct Rater {
  std::string label, user_id, name;
  int64_t rated = 0, to_rate = 0;
};

/// One session in a rater's queue, without anything that says whose it is.
struct QueuedRating {
  std::string key;                        ///< 16 hex digits: the rater's own name for the session
  std::string session;                    ///< not for the rater
  std::optional<nlohmann::json> answers;  ///< none yet
};

/// Raters of studies, who see replays without knowing whose they are, each in an order of their own. Only
/// while a study is open, for with its end it shows who is how experienced. Thread-safe; errors as those of
/// StudyService.
class RatingService {
 public:
  /// `studies` outlives it.
  RatingService(store::Database& database, const StudyService& studies,
                std::shared_ptr<const StudyDependencies> dependencies)
      : table_(database), studies_(studies), dependencies_(std::move(dependencies)) {}

  /// Error conflict for who cannot be blind: operators, and who rates there already.
  Rater add(const net::Caller& caller, const std::string& study, const std::string& user_id);
  /// With all their ratings. Error conflict once the study is closed.
  void remove(const std::string& study, const std::string& label);
  /// In the order in which they came.
  std::vector<Rater> raters(const net::Caller& caller, const std::string& study) const;

  /// What the caller rates, in the caller's order: sessions that were carried out on bone, of a study with a
  /// design its tests only, and none of the caller's own. Error not_found when they rate nothing there.
  std::vector<QueuedRating> queue(const net::Caller& caller, const std::string& study) const;
  QueuedRating queued(const net::Caller& caller, const std::string& study, const std::string& key) const;
  /// Keeps the caller's answers; they may change until the study is closed. RequestError 422 names what is
  /// wrong with them.
  void rate(const net::Caller& caller, const std::string& study, const std::string& key,
            const nlohmann::json& answers);

  /// Whether the caller is a rater of the study.
  bool rates(const net::Caller& caller, const std::string& study) const;
  /// Whether a session is hidden from the caller, who rates it and has a queue to see it in.
  bool hides(const net::Caller& caller, const session::SessionRequest& session) const;

 private:
  /// All sessions of the study that anybody may rate.
  std::vector<session::SessionRecord> rateable(const Study& study) const;
  std::vector<QueuedRating> queue_of(const Study& study, const store::RaterRow& rater,
                                     const std::vector<session::SessionRecord>& sessions) const;
  store::RaterRow rater_of(const net::Caller& caller, const std::string& study) const;

  store::RatingTable table_;
  const StudyService& studies_;
  const std::shared_ptr<const StudyDependencies> dependencies_;
};

}  // namespace ream::study
