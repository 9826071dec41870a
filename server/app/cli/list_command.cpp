#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/data_folder.hpp"
#include "case/case.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/log.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

/// Sorted sub-folders; none when the folder does not exist.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (entry.is_directory() && entry.path().extension() != ".tmp") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

nlohmann::json listed_case(const fs::path& folder) {
  const case_::CaseSummary c = case_::load_case_summary(folder);
  return {{"id", c.id},
          {"name", c.name},
          {"side", case_::to_text(c.side)},
          {"planned", c.planned},
          {"dims", {c.dims.x(), c.dims.y(), c.dims.z()}}};
}

nlohmann::json listed_session(const fs::path& folder) {
  nlohmann::json session = read_json_file(folder / "session.json");
  session["id"] = folder.filename().string();
  return session;
}

void list(const std::string& what, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  const bool cases = what == "cases";
  nlohmann::json rows = nlohmann::json::array();
  for (const fs::path& folder : folders_in(cases ? cases_folder(data) : sessions_folder(data))) try {
      rows.push_back(cases ? listed_case(folder) : listed_session(folder));
    } catch (const Error& e) {
      log::warn(e.what());
    }
  if (global.json) {
    std::cout << rows.dump() << '\n';
    return;
  }
  for (const auto& row : rows) {
    std::cout << row.at("id").get<std::string>() << '\t' << row.value(cases ? "name" : "case_name", "")
              << '\t' << row.value("side", "");
    if (cases) std::cout << '\t' << (row.at("planned").get<bool>() ? "planned" : "no plan");
    std::cout << '\n';
  }
}

}  // namespace

void add_list_command(CLI::App& app, GlobalOptions& global) {
  auto what = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("list", "List what is in the data folder");
  command->add_option("what", *what, "cases or sessions")
      ->required()
      ->check(CLI::IsMember({"cases", "sessions"}));
  command->callback([what, &global] { list(*what, global); });
}

}  // namespace ream::app
