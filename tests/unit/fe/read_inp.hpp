#pragma once
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace ream::fe::test {

/// An input file as a reader of a few lines sees it, without any of the product.
struct ReadInp {
  std::map<long, std::array<double, 3>> nodes;
  std::map<long, std::array<long, 8>> elements;
  std::map<std::string, std::vector<long>> sets;  ///< of elements and of nodes
  std::map<std::string, double> modulus_of_set;

  explicit ReadInp(const std::string& text) {
    std::istringstream in(text);
    std::string keyword, set, material;
    std::map<std::string, double> modulus;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("**")) continue;
      if (line.starts_with("*")) {
        keyword = line.substr(0, line.find(','));
        set = after(line, keyword == "*NSET" ? "NSET=" : "ELSET=");
        if (keyword == "*MATERIAL") material = after(line, "NAME=");
        if (keyword == "*SOLID SECTION") modulus_of_set[set] = modulus.at(after(line, "MATERIAL="));
        if (line.find("GENERATE") != std::string::npos) keyword = "generate";
        continue;
      }
      std::vector<double> n;
      std::istringstream words(line);
      if (keyword != "*HEADING")
        for (std::string word; std::getline(words, word, ',');) n.push_back(std::stod(word));
      if (keyword == "*NODE") nodes[static_cast<long>(n[0])] = {n[1], n[2], n[3]};
      if (keyword == "*ELEMENT")
        for (size_t k = 0; k < 8; ++k) elements[static_cast<long>(n[0])][k] = static_cast<long>(n.at(k + 1));
      if (keyword == "*ELSET" || keyword == "*NSET")
        for (const double id : n) sets[set].push_back(static_cast<long>(id));
      if (keyword == "generate")
        for (long id = static_cast<long>(n[0]); id <= static_cast<long>(n[1]); ++id) sets[set].push_back(id);
      if (keyword == "*ELASTIC") modulus[material] = n[0];
    }
  }

 private:
  static std::string after(const std::string& line, const std::string& key) {
    // NSET= is the end of ELSET= neither here nor there: a blank or comma stands before it.
    const size_t at = line.find(" " + key);
    if (at == std::string::npos) return {};
    const size_t begin = at + 1 + key.size();
    return line.substr(begin, std::min(line.find(',', begin), line.size()) - begin);
  }
};

}  // namespace ream::fe::test
