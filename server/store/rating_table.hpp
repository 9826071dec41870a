#pragma once
#include <map>
#include <string>
#include <vector>

#include "store/database.hpp"

namespace ream::store {

/// Somebody who rates sessions of a study.
struct RaterRow {
  std::string label;    ///< "R1": what exports call them
  std::string user_id;  ///< empty: a user who is gone
  std::string name;     ///< for people
};

/// What one rater says of one session.
struct RatingRow {
  std::string rater;    ///< its label
  std::string session;  ///< its id
  std::string answers;  ///< JSON
};

/// Raters of studies and their ratings. Thread-safe; errors are those of Database, and not_found where a row
/// that is to be changed is not there.
class RatingTable {
 public:
  explicit RatingTable(Database& database) : database_(database) {}

  /// The label: "R" and the number behind the highest that is there. Error conflict when the user rates
  /// there already.
  std::string add_rater(const std::string& study, const std::string& user_id, const std::string& name);
  /// With all ratings.
  void remove_rater(const std::string& study, const std::string& label);
  /// In the order in which they came.
  std::vector<RaterRow> raters(const std::string& study) const;
  /// Label of the user in each study that they rate.
  std::map<std::string, std::string> labels_of(const std::string& user_id) const;
  /// Nobody knows any more who the rater is; the ratings stay.
  void forget_user(const std::string& user_id);

  /// Keeps a rating, in the place of the one that was there.
  void set(const std::string& study, const RatingRow& rating);
  /// By rater, then session.
  std::vector<RatingRow> ratings(const std::string& study) const;

 private:
  Database& database_;
};

}  // namespace ream::store
