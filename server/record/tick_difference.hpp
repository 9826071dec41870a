#pragma once
#include <optional>
#include <string>

#include "record/ops.hpp"

namespace ream::record {

/// How two things that should be the same are not.
struct Difference {
  std::string kind;   ///< pose, bone or force, or what else there is to compare
  std::string field;  ///< name in proto/recording.json, where it is one
  std::string recorded, found;
};

/// Which columns are compared.
enum class Columns {
  all,
  without_vibration,  ///< neither vibration nor the hand force that holds it
};

/// The first field in which a tick that was computed again differs: first the cause and the pose that was
/// decided, then bone, then what followed. Floats are compared bit for bit.
std::optional<Difference> first_difference(const ops::Tick& recorded, const ops::Tick& found,
                                           Columns columns);

}  // namespace ream::record
