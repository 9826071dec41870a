#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "access/access_control.hpp"
#include "app/backup.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/open_database.hpp"
#include "app/restore_backup.hpp"
#include "core/atomic_file.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/leftovers.hpp"
#include "core/log.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

struct BackupOptions {
  fs::path file;
  RestoreOptions restore;
};

size_t count_of(const std::map<std::string, size_t>& counts, const std::string& folder) {
  const auto found = counts.find(folder);
  return found == counts.end() ? 0 : found->second;
}

std::string alt_text(const std::map<std::string, size_t>& counts, uint64_t rows) {
  const auto counted = [](uint64_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  return counted(count_of(counts, "sessions"), "session") + ", " +
         counted(count_of(counts, "cases"), "case") + ", " + counted(rows, "row");
}

/// In the audit log of the database as it is now.
void note(store::Database& database, const std::string& action, const std::string& detail) {
  access::AccessControl(database).audit.note(command_line_actor(), action, "", detail);
}

/// 0 for a log without rows.
int64_t last_audit_row(store::Database& database) {
  const auto rows = access::AccessControl(database).audit.list(std::numeric_limits<int64_t>::max(), 1);
  return rows.empty() ? 0 : rows.front().number;
}

void back_up(const BackupOptions& options, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  std::error_code failed;
  if (!fs::is_directory(data, failed))
    throw Error(ErrorKind::not_found, "there is no data folder " + data.string() + " to back up; see --data");
  require_replaceable(options.file);
  catch_interrupts();
  remove_leftovers(data);
  remove_leftovers_beside(options.file);
  const auto database = open_database(global.db, data);
  BackupReport report;
  {
    const TerminalProgress progress;
    report = write_backup(*database, data, options.file, std::cref(progress));
  }
  try {
    note(*database, "data.backup", options.file.filename().string());
  } catch (const Error& failure) {
    // Who saves what is on a full disk shall have it.
    log::warn(std::string("the audit log does not have this backup: ") + failure.what());
  }
  for (const std::string& id : report.live)
    log::warn("session " + id + " is live; it is kept as far as it had come");
  if (global.json)
    std::cout << nlohmann::json{{"out", options.file.string()},
                                {"bytes", fs::file_size(options.file)},
                                {"sessions", count_of(report.counts, "sessions")},
                                {"cases", count_of(report.counts, "cases")},
                                {"rows", report.rows},
                                {"live", report.live}}
                     .dump()
              << '\n';
  else
    std::cout << options.file.string() << ": " << alt_text(report.counts, report.rows) << '\n';
}

void restore(const BackupOptions& options, const GlobalOptions& global) {
  const fs::path data = data_folder(global.data);
  require_backup(options.file);
  catch_interrupts();
  const auto database = open_database(global.db, data);
  make_data_folder(data);
  const int64_t last_row = last_audit_row(*database);
  RestoreReport report;
  {
    const TerminalProgress progress;
    report = restore_backup(*database, data, options.file, options.restore, std::cref(progress));
  }
  note(*database, "data.restore",
       options.file.filename().string() + "; the log before it ended with row " + std::to_string(last_row));
  log::info(options.restore.keep_tokens
                ? "logins and viewer links are not restored; tokens are, also those revoked since the backup"
                : "logins, viewer links and tokens are not restored; make new ones (or restore with "
                  "--keep-tokens)");
  log::info("passwords are those of the backup, and sessions that were erased since are back");
  if (!report.aside.empty()) log::info("what was there before is in " + report.aside.string());
  if (global.json)
    std::cout << nlohmann::json{{"data", data.string()},
                                {"database", database->name()},
                                {"sessions", count_of(report.counts, "sessions")},
                                {"cases", count_of(report.counts, "cases")},
                                {"rows", report.rows},
                                {"aside", report.aside.empty() ? nlohmann::json()
                                                               : nlohmann::json(report.aside.string())}}
                     .dump()
              << '\n';
  else
    std::cout << data.string() << ": " << alt_text(report.counts, report.rows) << '\n';
}

}  // namespace

void add_backup_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<BackupOptions>();
  CLI::App* command = app.add_subcommand(
      "backup",
      "Write sessions, cases, reamers and the database's tables into one file; a server may run meanwhile");
  command->add_option("FILE", options->file, "Zip file to write; an old one of that name is replaced")
      ->required();
  command->callback([options, &global] { back_up(*options, global); });
}

void add_restore_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<BackupOptions>();
  CLI::App* command = app.add_subcommand(
      "restore", "Put a backup into an empty data folder and an empty database of either kind");
  command->add_option("FILE", options->file, "What ream backup has written")->required();
  command->add_flag("--force", options->restore.force, "Move aside what is there, within the data folder");
  command->add_flag("--keep-tokens", options->restore.keep_tokens,
                    "Tokens of the backup are good again, also those that were revoked since");
  command->callback([options, &global] { restore(*options, global); });
}

}  // namespace ream::app
