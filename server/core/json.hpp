#pragma once
#include <nlohmann/json.hpp>

/// Compiled once, in json.cpp: nlohmann's class takes each source that uses it a tenth of its compile time.
extern template class nlohmann::basic_json<>;
