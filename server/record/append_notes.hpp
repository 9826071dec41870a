#pragma once
#include <vector>

#include "record/note.hpp"
#include "record/op_log.hpp"

namespace ream::record {

/// Appends one chunk of notes behind what `log` has found whole, fsynced; what is behind that in the file is
/// cut off. Error io when it cannot be written; the file is then as it was.
void append_notes(const OpLogReader& log, const std::vector<Note>& notes);

}  // namespace ream::record
