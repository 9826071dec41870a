#include <cstdlib>
#include <functional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "bench/validate/validate_parts.hpp"
#include "core/error.hpp"

namespace ream::bench {
namespace {

struct ValidatePart {
  const char* name;
  std::function<std::vector<Row>(const Options&, Plots&)> rows;
};

const ValidatePart validate_parts[] = {
    {"feed", feed_rows},
    {"edge", [](const Options& options, Plots&) { return edge_rows(options); }},
    {"steady", [](const Options& options, Plots&) { return steady_rows(options); }},
    {"protocol", protocol_rows},
    {"scatter", [](const Options& options, Plots&) { return scatter_rows(options); }},
    {"vibration", vibration_rows},
    {"cost", [](const Options&, Plots&) { return force_cost_rows(); }},
    {"ct", [](const Options& options, Plots&) { return scan_rows(options); }},
    {"ct-fine", [](const Options& options, Plots&) { return fine_scan_rows(options); }},
    {"version", [](const Options& options, Plots&) { return version_rows(options); }}};

/// The parts that REAM_VALIDATE_ONLY names, with commas between; all of them where it is not set.
std::vector<const ValidatePart*> wanted_parts() {
  std::vector<const ValidatePart*> wanted;
  const char* only = std::getenv("REAM_VALIDATE_ONLY");
  if (!only) {
    for (const ValidatePart& part : validate_parts) wanted.push_back(&part);
    return wanted;
  }
  std::istringstream words(only);
  for (std::string word; std::getline(words, word, ',');) {
    const size_t before = wanted.size();
    for (const ValidatePart& part : validate_parts)
      if (word == part.name) wanted.push_back(&part);
    if (wanted.size() == before)
      throw Error(ErrorKind::usage, "REAM_VALIDATE_ONLY: there is no part '" + word + "'");
  }
  return wanted;
}

}  // namespace

std::vector<Row> validate_suite(const Options& options) {
  Plots plots(options.plots);
  std::vector<Row> rows;
  for (const ValidatePart* part : wanted_parts())
    for (Row& row : part->rows(options, plots)) rows.push_back(std::move(row));
  const std::string outcome = plots.draw();
  if (options.tables != nullptr) *options.tables << '\n' << outcome << '\n';
  return rows;
}

}  // namespace ream::bench
