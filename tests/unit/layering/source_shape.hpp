#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ream::layering {

/// A function with a body, as clang-format lays it out.
struct FunctionLines {
  std::string place;  ///< "file:line" of its first line
  int lines = 0;      ///< from there to its closing brace
};

/// What a source file or header declares for others, in its namespaces.
struct Declarations {
  int functions = 0;  ///< free ones, each overload
  int types = 0;      ///< classes, structures, unions, enumerations and aliases; no forward declarations
};

/// The C++ text without comments and preprocessor lines, and with literals emptied; lines stay lines.
std::string bare_code(const std::string& text);

/// Lambdas and local types count as part of the function that holds them.
std::vector<FunctionLines> function_lines(const std::string& path, const std::string& text);
Declarations declarations(const std::string& text);

}  // namespace ream::layering
