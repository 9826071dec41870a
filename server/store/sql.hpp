#pragma once
/// What repositories need of SOCI. Included by sources of this room only.
///
///   database.run([&](Sql& sql) {
///     sql << "INSERT INTO users (id, name) VALUES (:id, :name)", use(user.id), use(user.name);
///   });
///   database.read([&](Sql& sql) {
///     User user;
///     sql << "SELECT id, name FROM users WHERE id = :id", use(id), into(user.id), into(user.name);
///     return sql.got_data() ? std::optional(user) : std::nullopt;
///   });
///
/// SQL is what both stores understand ("ON CONFLICT (id) DO UPDATE SET name = excluded.name" is). Columns are
/// NOT NULL, for into() of a NULL throws. Whole numbers are read into long long or int64_t; SOCI knows no
/// bool.
#include <soci/soci.h>
#include <string>
#include <type_traits>

#include "core/error.hpp"
#include "store/database.hpp"

namespace ream::store {

using soci::into;

/// The text itself. One that PostgreSQL cannot hold as it is (a NUL, bytes that are no UTF-8) becomes empty,
/// and the transaction fails at its end with Error invalid_input: SOCI bears no exception inside a statement.
const std::string& storable(const std::string& text);
/// Throws that error if this thread gave such a text since forget_unstorable().
void refuse_unstorable();
void forget_unstorable();

inline const std::string no_name;  ///< what SOCI keeps for a parameter lives longer than a default argument

/// A parameter, by place. `value` lives until the statement has run.
template <typename T>
auto use(const T& value) {
  if constexpr (std::is_same_v<T, std::string>)
    return soci::use(storable(value), no_name);
  else
    return soci::use(value, no_name);
}
template <typename T>
void use(const T&&) = delete;

/// Runs what was prepared and calls `row` after each row has come.
template <typename Row>
void for_each_row(const soci::details::prepare_temp_type& prepared, Row&& row) {
  soci::statement statement(prepared);
  statement.execute();
  while (statement.fetch()) row();
}

/// A statement with as many parameters as it turns out to need.
class OpenStatement {
 public:
  OpenStatement(Sql& sql, const std::string& text) : made_(sql.prepare << text) {}
  template <typename T>
  OpenStatement& with(const T& value) {
    made_, use(value);
    return *this;
  }
  /// Columns come into these variables, row by row.
  template <typename T>
  OpenStatement& into(T& value) {
    made_, soci::into(value);
    return *this;
  }
  /// With room for NULL.
  template <typename T>
  OpenStatement& with(const T& value, soci::indicator& indicator) {
    made_, soci::use(value, indicator, no_name);
    return *this;
  }
  template <typename T>
  OpenStatement& into(T& value, soci::indicator& indicator) {
    made_, soci::into(value, indicator);
    return *this;
  }
  /// Calls `row` after each row has come.
  template <typename Row>
  void each(Row&& row) {
    for_each_row(made_, std::forward<Row>(row));
  }
  /// To be executed again and again, with what the variables of with() hold each time.
  soci::statement prepared() { return soci::statement(made_); }

 private:
  soci::details::prepare_temp_type made_;
};

/// What a failed statement means for its transaction. Internal to this room.
struct SqlFailure {
  bool lost = false;   ///< the connection is of no more use
  bool again = false;  ///< the same transaction may well succeed when it is run again
  Error error;         ///< for the caller: one line, without values of parameters
};

/// `database`: its name for people.
SqlFailure failure_of(const soci::soci_error& error, bool connection_lost, const std::string& database);

}  // namespace ream::store
