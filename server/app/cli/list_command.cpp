#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "session/folder/index_upkeep.hpp"
#include "session/folder/session_archive.hpp"
#include "workup/case_json.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

/// Sub-folders; none when the folder does not exist.
std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code gone;
  for (const fs::path& path : paths_in(folder))
    if (fs::is_directory(path, gone) && path.extension() != ".tmp") found.push_back(path);
  return found;
}

nlohmann::json listed_cases(const fs::path& data) {
  nlohmann::json rows = nlohmann::json::array();
  for (const fs::path& folder : folders_in(cases_folder(data))) try {
      if (workup::is_case_folder(folder)) rows.push_back(workup::case_summary_json(folder));
    } catch (const Error& e) {
      log::warn(e.what());
    }
  return rows;
}

/// session.json with what the folder adds to it, newest first.
nlohmann::json listed_sessions(const fs::path& data) {
  const session::SessionArchive archive(sessions_folder(data));
  nlohmann::json rows = nlohmann::json::array();
  for (const session::SessionRecord& record : archive.list()) {
    const std::string& id = record.request.id;
    nlohmann::json row = read_json_file(session::session_json(archive.folder_of(id)));
    row["id"] = id;
    row["state"] = to_text(record.status.state);
    row["created_utc"] = record.request.created_utc;
    row["duration_s"] = record.status.duration_s;
    rows.push_back(std::move(row));
  }
  return rows;
}

void print_case(const nlohmann::json& row) {
  std::cout << row.at("id").get<std::string>() << '\t' << row.value("name", "") << '\t'
            << row.value("side", "") << '\t' << (row.at("planned").get<bool>() ? "planned" : "no plan");
  if (const std::string stage = row.at("stage"); stage != "built")
    std::cout << '\t' << (stage == "ct" ? "CT only" : "segmented") << ", not built yet";
  std::cout << '\n';
}

void print_session(const nlohmann::json& row) {
  const auto text = [&row](const char* key) { return row.at(key).get<std::string>(); };
  std::cout << text("id") << '\t' << row.value("case_name", "") << '\t' << row.value("side", "") << '\t'
            << text("state") << '\t' << text("created_utc") << '\t' << row.at("duration_s").get<double>()
            << " s\n";
}

struct ListOptions {
  std::string what;
  bool rebuild_index = false;
};

void list(const ListOptions& options, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  const bool cases = options.what == "cases";
  if (options.rebuild_index) {
    if (cases)
      throw Error(ErrorKind::usage, "only sessions have an index; give list sessions --rebuild-index");
    const size_t count = session::rebuild_index(session::SessionArchive(sessions_folder(data)),
                                                *open_database(global.db, data));
    log::info("the index of sessions has been rebuilt: " + std::to_string(count));
  }
  const nlohmann::json rows = cases ? listed_cases(data) : listed_sessions(data);
  if (global.json) {
    std::cout << rows.dump() << '\n';
    return;
  }
  for (const auto& row : rows) cases ? print_case(row) : print_session(row);
}

}  // namespace

void add_list_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ListOptions>();
  CLI::App* command = app.add_subcommand("list", "List what is in the data folder");
  command->add_option("what", options->what, "cases or sessions")
      ->required()
      ->check(CLI::IsMember({"cases", "sessions"}));
  command->add_flag("--rebuild-index", options->rebuild_index,
                    "Rebuild the index of sessions in the database from their folders first");
  command->callback([options, &global] { list(*options, global); });
}

}  // namespace ream::app
