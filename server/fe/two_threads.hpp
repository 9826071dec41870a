#pragma once
#include <cstddef>
#include <functional>
#include <string_view>

#include "core/progress.hpp"

namespace ream::fe {

/// Calls work(i) for every i below count, on this thread and a second one, each taking the next that nobody
/// has taken. `progress` is told of it on this thread. When a call throws, no more are begun, and the error
/// that came first is thrown again once both threads rest.
void on_two_threads(size_t count, const std::function<void(size_t)>& work,
                    const Progress& progress = no_progress, std::string_view step = {});

}  // namespace ream::fe
