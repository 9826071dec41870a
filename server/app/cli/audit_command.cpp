#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "access/audit_log.hpp"
#include "app/cli/commands.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"

namespace ream::app {
namespace {

using nlohmann::json;

constexpr int exported_at_once = 1000;

json to_json(const store::AuditRow& row) {
  return {{"number", row.number},   {"at_utc", row.at_utc}, {"user_id", row.user_id},
          {"name", row.name},       {"role", row.role},     {"credential", row.credential},
          {"address", row.address}, {"action", row.action}, {"object", row.object},
          {"detail", row.detail},   {"nonce", row.nonce},   {"seal", row.seal},
          {"chain", row.chain}};
}

void export_audit(const GlobalOptions& global) {
  const auto database = open_database(global.db, data_folder(global.data));
  const access::AuditLog audit(*database, machine_clock());
  int64_t after = 0;
  for (auto rows = audit.list_from(after, exported_at_once); !rows.empty();
       rows = audit.list_from(after, exported_at_once))
    for (const store::AuditRow& row : rows) {
      std::cout << to_json(row).dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
      after = row.number;
    }
}

/// "NUMBER:CHAIN" as verify has told it.
store::AuditHead head_from(const std::string& text) {
  store::AuditHead head;
  const size_t colon = std::min(text.find(':'), text.size());
  const auto read = std::from_chars(text.data(), text.data() + colon, head.number);
  if (colon == text.size() || read.ec != std::errc() || read.ptr != text.data() + colon || head.number < 1)
    throw Error(ErrorKind::usage, "--head " + text + ": give what ream audit verify has told, NUMBER:CHAIN");
  head.chain = text.substr(colon + 1);
  return head;
}

void verify_audit(const std::string& written_down, const GlobalOptions& global) {
  const store::AuditHead expected = written_down.empty() ? store::AuditHead{} : head_from(written_down);
  const auto database = open_database(global.db, data_folder(global.data));
  const access::AuditCheck check = access::AuditLog(*database, machine_clock()).check(expected);
  const std::string head = std::to_string(check.head.number) + ":" + check.head.chain;
  if (global.json)
    std::cout << json{{"rows", check.rows},
                      {"anonymous", check.anonymous},
                      {"head", head},
                      {"faults", check.faults}}
                     .dump()
              << '\n';
  else
    for (const std::string& fault : check.faults) std::cout << fault << '\n';
  if (!check.faults.empty())
    throw Error(ErrorKind::conflict, "the audit log was changed: " + std::to_string(check.faults.size()) +
                                         (check.faults.size() == 1 ? " fault" : " faults"));
  if (!global.json)
    std::cout << check.rows << " rows are whole, " << check.anonymous << " of them anonymous; head " << head
              << '\n';
}

}  // namespace

void add_audit_command(CLI::App& app, GlobalOptions& global) {
  CLI::App* command =
      app.add_subcommand("audit", "Who has changed and read what; a server may run meanwhile");
  command->require_subcommand(1);
  command->fallthrough();
  command->add_subcommand("export", "Write all rows to stdout, one JSON object a line, oldest first")
      ->callback([&global] { export_audit(global); });
  auto head = std::make_shared<std::string>();
  CLI::App* verifying =
      command->add_subcommand("verify", "Tell which rows were changed, taken out or put in, one line each");
  verifying->add_option("--head", *head,
                        "What verify told before, kept elsewhere: it must still be in the log");
  verifying->callback([head, &global] { verify_audit(*head, global); });
}

}  // namespace ream::app
