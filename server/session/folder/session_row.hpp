#pragma once
#include "session/folder/session_folder.hpp"
#include "store/session_query.hpp"

namespace ream::session {

/// What lists filter and sort a session by.
store::SessionRow row_of(const SessionRecord& record);

/// The whole row of the index, to be read again by record_from_text().
store::SessionRow row_of(const FolderRecord& found, int64_t stamp);

}  // namespace ream::session
