#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/doctor.hpp"
#include "app/cli/serve_options.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"

namespace ream::app {
namespace {

const char* word(Finding::State state) {
  switch (state) {
    case Finding::State::good: return "good";
    case Finding::State::remark: return "remark";
    case Finding::State::fault: break;
  }
  return "fault";
}

void print(const std::vector<Finding>& findings, bool for_programs) {
  if (for_programs) {
    nlohmann::json all = nlohmann::json::array();
    for (const Finding& finding : findings)
      all.push_back({{"subject", finding.subject},
                     {"state", word(finding.state)},
                     {"text", finding.text},
                     {"remedy", finding.remedy}});
    std::cout << nlohmann::json{{"findings", all}}.dump(2) << '\n';
    return;
  }
  for (const Finding& finding : findings) {
    std::cout << word(finding.state) << '\t' << finding.text << '\n';
    if (!finding.remedy.empty()) std::cout << "\t-> " << finding.remedy << '\n';
  }
}

void examine(const GlobalOptions& global, const ServeOptions& serve) {
  const std::vector<Finding> findings =
      examine_machine({data_folder(global.data), global.db, serve.web, serve.address});
  print(findings, global.json);
  for (const Finding& finding : findings)
    if (finding.state == Finding::State::fault)
      throw Error(ErrorKind::unavailable, "this machine cannot serve yet: " + finding.subject);
}

}  // namespace

void add_doctor_command(CLI::App& app, GlobalOptions& global, std::shared_ptr<const ServeOptions> serve) {
  app.add_subcommand("doctor", "Tell what this machine lacks for ream serve, and what to do")
      ->callback([&global, serve = std::move(serve)] { examine(global, *serve); });
}

}  // namespace ream::app
