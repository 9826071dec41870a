#pragma once
#include <filesystem>

#include "api/score_tools.hpp"

namespace ream::app {

/// How a server scores the sessions of a data folder.
api::ScoreMakers score_makers(const std::filesystem::path& data);

}  // namespace ream::app
