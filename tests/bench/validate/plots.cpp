#include "bench/validate/plots.hpp"

#include <cstdlib>
#include <sstream>
#include <system_error>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream::bench {
namespace fs = std::filesystem;

Plots::Plots(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  if (failed)
    throw Error(ErrorKind::io, "cannot make the folder " + folder_.string() + ": " + failed.message());
}

void Plots::data(const std::string& name, const std::string& columns,
                 const std::vector<std::vector<double>>& rows) {
  std::ostringstream text;
  text.precision(7);
  text << "# " << columns << '\n';
  for (const auto& row : rows) {
    for (size_t i = 0; i < row.size(); ++i) text << (i > 0 ? " " : "") << row[i];
    text << '\n';
  }
  write_file_atomically(folder_ / (name + ".dat"), text.str());
}

void Plots::script(const std::string& name, const std::string& commands) {
  write_file_atomically(folder_ / (name + ".gp"),
                        "set terminal pngcairo size 900,600 font 'DejaVu Sans,11'\nset output '" + name +
                            ".png'\nset grid lc rgb '#dddddd'\n" + commands + "\n");
  scripts_.push_back(name);
}

std::string Plots::draw() const {
  // The shell is only asked to change folder: names are ours, the folder is quoted.
  std::string quoted = "'";
  for (const char c : folder_.string()) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  quoted += "'";
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0)
    return "data and gnuplot scripts are in " + folder_.string() +
           "; install gnuplot-nox to have them drawn (scripts/setup --bench does)";
  for (const std::string& name : scripts_)
    if (std::system(("cd " + quoted + " && gnuplot " + name + ".gp").c_str()) != 0)
      return "gnuplot could not draw " + (folder_ / (name + ".gp")).string();
  return "pictures are in " + folder_.string();
}

}  // namespace ream::bench
