#include <ostream>

#include "bench/validate/validate_parts.hpp"

namespace ream::bench {

std::vector<Row> validate_suite(const Options& options) {
  Plots plots(options.plots);
  std::vector<Row> rows = feed_rows(options, plots);
  const auto append = [&rows](std::vector<Row> more) {
    rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  append(edge_rows(options));
  append(steady_rows(options));
  append(protocol_rows(options, plots));
  append(vibration_rows(options, plots));
  append(force_cost_rows());
  const std::string outcome = plots.draw();
  if (options.tables != nullptr) *options.tables << '\n' << outcome << '\n';
  return rows;
}

}  // namespace ream::bench
