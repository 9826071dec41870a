#include "store/rating_table.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "store/sql.hpp"

namespace ream::store {
namespace {

std::vector<RaterRow> raters_of(Sql& sql, const std::string& study) {
  std::vector<RaterRow> found;
  RaterRow row;
  for_each_row((sql.prepare << "SELECT label, user_id, name FROM study_raters WHERE study = :study "
                               "ORDER BY LENGTH(label), label",
                use(study), into(row.label), into(row.user_id), into(row.name)),
               [&] { found.push_back(row); });
  return found;
}

int number_of(const std::string& label) { return std::stoi(label.substr(1)); }

bool has_rater(Sql& sql, const std::string& study, const std::string& label) {
  int count = 0;
  sql << "SELECT COUNT(*) FROM study_raters WHERE study = :study AND label = :label", use(study), use(label),
      into(count);
  return count > 0;
}

[[noreturn]] void refuse_unknown(const std::string& study, const std::string& label) {
  throw Error(ErrorKind::not_found, "no rater '" + label + "' in study '" + study + "'");
}

}  // namespace

std::string RatingTable::add_rater(const std::string& study, const std::string& user_id,
                                   const std::string& name) {
  return database_.run([&](Sql& sql) {
    int last = 0;
    for (const RaterRow& rater : raters_of(sql, study)) last = std::max(last, number_of(rater.label));
    const std::string label = "R" + std::to_string(last + 1);
    sql << "INSERT INTO study_raters (study, label, user_id, name) VALUES (:study, :label, :user_id, :name)",
        use(study), use(label), use(user_id), use(name);
    return label;
  });
}

void RatingTable::remove_rater(const std::string& study, const std::string& label) {
  database_.run([&](Sql& sql) {
    if (!has_rater(sql, study, label)) refuse_unknown(study, label);
    sql << "DELETE FROM study_ratings WHERE study = :study AND rater = :label", use(study), use(label);
    sql << "DELETE FROM study_raters WHERE study = :study AND label = :label", use(study), use(label);
  });
}

std::vector<RaterRow> RatingTable::raters(const std::string& study) const {
  return database_.read([&](Sql& sql) { return raters_of(sql, study); });
}

std::map<std::string, std::string> RatingTable::labels_of(const std::string& user_id) const {
  if (user_id.empty()) return {};
  return database_.read([&](Sql& sql) {
    std::map<std::string, std::string> found;
    std::string study, label;
    for_each_row((sql.prepare << "SELECT study, label FROM study_raters WHERE user_id = :user_id",
                  use(user_id), into(study), into(label)),
                 [&] { found[study] = label; });
    return found;
  });
}

void RatingTable::forget_user(const std::string& user_id) {
  database_.run([&](Sql& sql) {
    sql << "UPDATE study_raters SET user_id = '', name = '' WHERE user_id = :user_id", use(user_id);
  });
}

void RatingTable::set(const std::string& study, const RatingRow& rating) {
  database_.run([&](Sql& sql) {
    if (!has_rater(sql, study, rating.rater)) refuse_unknown(study, rating.rater);
    sql << "DELETE FROM study_ratings WHERE study = :study AND rater = :rater AND session = :session",
        use(study), use(rating.rater), use(rating.session);
    sql << "INSERT INTO study_ratings (study, rater, session, answers) VALUES (:study, :rater, :session, "
           ":answers)",
        use(study), use(rating.rater), use(rating.session), use(rating.answers);
  });
}

std::vector<RatingRow> RatingTable::ratings(const std::string& study) const {
  return database_.read([&](Sql& sql) {
    std::vector<RatingRow> found;
    RatingRow row;
    for_each_row((sql.prepare << "SELECT rater, session, answers FROM study_ratings WHERE study = :study "
                                 "ORDER BY LENGTH(rater), rater, session",
                  use(study), into(row.rater), into(row.session), into(row.answers)),
                 [&] { found.push_back(row); });
    return found;
  });
}

}  // namespace ream::store
