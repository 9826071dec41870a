#pragma once
#include <soci/soci.h>

#include "store/database.hpp"

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
/// SQL is what both stores understand ("ON CONFLICT (id) DO UPDATE SET name = excluded.name" is). A value
/// given to use() lives until the statement has run. Columns are NOT NULL, for into() of a NULL throws. Whole
/// numbers are read into long long; SOCI knows no bool and no uint64_t.
namespace ream::store {

using soci::into;
using soci::use;

}  // namespace ream::store
