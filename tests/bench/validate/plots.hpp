#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace ream::bench {

/// Pictures of a suite: data files and gnuplot scripts in a folder, drawn where gnuplot is installed.
class Plots {
 public:
  /// Makes the folder. Throws Error io when it cannot.
  explicit Plots(std::filesystem::path folder);

  /// `<name>.dat`: a line of column names, then the rows.
  void data(const std::string& name, const std::string& columns,
            const std::vector<std::vector<double>>& rows);
  /// `<name>.gp`, which draws `<name>.png`; `commands` go between the common head and the end. Files are
  /// named as data() wrote them.
  void script(const std::string& name, const std::string& commands);
  /// Draws every script. One sentence for people: where the pictures are, or why there are none.
  std::string draw() const;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> scripts_;
};

}  // namespace ream::bench
