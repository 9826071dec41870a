#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/cli/commands.hpp"
#include "record/trace_columns.hpp"
#include "score/metric_catalogue.hpp"
#include "session/scoring/export_table.hpp"

namespace ream::app {
namespace {

session::ExportTable trace_codebook() {
  session::ExportTable book{
      "trace", {{"column", "", "Name"}, {"unit", "", "Unit"}, {"meaning", "", "Meaning"}}, {}};
  for (const record::TraceColumn& column : record::trace_columns())
    book.rows.push_back({column.name, column.unit, column.meaning});
  return book;
}

session::ExportTable metrics_codebook() {
  session::ExportTable book{"metrics",
                            {{"metric", "", "Key in metrics.json"},
                             {"name", "", "Name"},
                             {"unit", "", "Unit"},
                             {"meaning", "", "Meaning"},
                             {"source", "", "Source"}},
                            {}};
  for (const score::Metric& metric : score::metric_catalogue())
    book.rows.push_back({metric.key, metric.name, metric.unit, metric.definition, metric.source});
  return book;
}

}  // namespace

void add_codebook_command(CLI::App& app, GlobalOptions& global) {
  auto of = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "codebook", "Print what the columns of trace.csv or the keys of metrics.json mean, as CSV");
  command->add_option("OF", *of, "trace or metrics")->check(CLI::IsMember({"trace", "metrics"}))->required();
  command->callback([of, &global] {
    const session::ExportTable book = *of == "trace" ? trace_codebook() : metrics_codebook();
    if (global.json)
      std::cout << session::json_of(book).dump() << '\n';
    else
      std::cout << session::csv_of(book);
  });
}

}  // namespace ream::app
