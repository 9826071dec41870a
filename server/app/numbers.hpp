#pragma once
#include <string>
#include <vector>

namespace ream::app {

/// `count` finite numbers separated by commas. Error usage naming `option` otherwise.
std::vector<double> parse_numbers(const std::string& text, size_t count, const std::string& option);

/// With so many digits behind the point.
std::string rounded(double value, int digits);

}  // namespace ream::app
