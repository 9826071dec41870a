#pragma once
#include <variant>
#include <vector>

#include "record/op_log.hpp"

namespace ream::record {

/// What may follow in a recording that nobody writes any more.
using Note = std::variant<ops::Event, ops::Annotation, ops::End>;

/// Appends one chunk of notes behind what `log` has found whole, fsynced; what is behind that in the file is
/// cut off. Error io when it cannot be written; the file is then as it was.
void append_notes(const OpLogReader& log, const std::vector<Note>& notes);

}  // namespace ream::record
