#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ream::app {

/// One sentence about the first argument that is no command or option of `app`, with the nearest that is one;
/// empty when all are known. `arguments`: without the program's name.
std::string unknown_argument(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace ream::app
