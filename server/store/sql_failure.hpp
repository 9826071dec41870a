#pragma once
#include <string>

#include "core/error.hpp"
#include "store/sql.hpp"

namespace ream::store {

/// What a failed statement means for its transaction. Internal to this room.
struct SqlFailure {
  bool lost = false;   ///< the connection is of no more use
  bool again = false;  ///< the same transaction may well succeed when it is run again
  Error error;         ///< for the caller: one line, without values of parameters
};

/// `database`: its name for people.
SqlFailure failure_of(const soci::soci_error& error, bool connection_lost, const std::string& database);

}  // namespace ream::store
