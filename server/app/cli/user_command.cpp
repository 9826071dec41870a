#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "access/access_control.hpp"
#include "api/replies.hpp"
#include "app/cli/commands.hpp"
#include "app/open_database.hpp"
#include "app/password_prompt.hpp"
#include "app/person_data.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"

namespace ream::app {
namespace {

using access::CredentialKind;
using access::Role;
using nlohmann::json;

struct UserOptions {
  std::string name, display_name, role, words, credential;
  int expires_days = 90;
  bool keep_tokens = false;
};

const std::vector<std::string> account_roles = {"operator", "instructor", "trainee"};
const std::vector<std::string> token_roles = {"operator", "instructor", "trainee", "viewer"};

/// The database and what stands on it, for one command.
struct Office {
  explicit Office(const GlobalOptions& global)
      : database(open_database(global.db, data_folder(global.data))), access_control(*database) {}

  access::User user(const std::string& name) const {
    if (const auto found = access_control.users.find_by_name(name)) return *found;
    throw Error(ErrorKind::not_found, "no user '" + name + "'; ream user list shows them");
  }
  void note(const std::string& action, const std::string& object, const std::string& detail) {
    access_control.audit.note(command_line_actor(), action, object, detail);
  }

  std::shared_ptr<store::Database> database;
  access::AccessControl access_control;
};

json to_json(const store::CredentialRow& row) {
  return {{"id", row.id},
          {"user_id", row.user_id},
          {"name", row.name},
          {"role", row.role},
          {"session", row.session_id},
          {"created_utc", row.created_utc},
          {"expires_utc", row.expires_utc},
          {"last_used_utc", or_null(row.last_used_utc)}};
}

void print_result(const GlobalOptions& global, const json& for_programs, const std::string& for_people) {
  std::cout << (global.json ? for_programs.dump() : for_people) << '\n';
}

void add(const UserOptions& options, const GlobalOptions& global) {
  Office office(global);
  const bool first = !office.access_control.users.any();
  const std::string name = lower(options.name);
  access::require_user_name(name);
  if (office.access_control.users.find_by_name(name))
    throw Error(ErrorKind::conflict, "there is a user '" + name + "' already");
  access::NewUser wanted;
  wanted.name = name;
  wanted.display_name = options.display_name;
  wanted.role =
      options.role.empty() ? (first ? Role::operator_ : Role::trainee) : *access::role_from(options.role);
  if (first && wanted.role != Role::operator_)
    throw Error(ErrorKind::conflict, "the first user must be operator");
  wanted.password = ask_new_password(name);
  const access::User user = office.access_control.users.add(wanted);
  office.note("user.add", user.id, user.name + " as " + access::to_text(user.role));
  print_result(global, api::user_json(user),
               user.name + " is " + access::to_text(user.role) +
                   (first ? "; from now on everybody has to log in" : ""));
}

void print_row(const json& row, const std::string& kind, const std::string& owner) {
  std::cout << kind << '\t' << row.at("id").get<std::string>() << '\t' << (owner.empty() ? "-" : owner)
            << '\t' << row.at("name").get<std::string>() << "\tuntil "
            << row.at("expires_utc").get<std::string>()
            << (row.at("last_used_utc").is_null() ? "\tnever used"
                                                  : "\tused " + row.at("last_used_utc").get<std::string>())
            << '\n';
}

void list(const GlobalOptions& global) {
  Office office(global);
  std::map<std::string, std::string> names;
  json all = {{"users", json::array()}, {"tokens", json::array()}, {"links", json::array()}};
  for (const access::User& user : office.access_control.users.list()) {
    all["users"].push_back(api::user_json(user));
    names[user.id] = user.name;
  }
  for (const auto& row : office.access_control.credentials.list(CredentialKind::token, ""))
    all["tokens"].push_back(to_json(row));
  for (const auto& row : office.access_control.credentials.list(CredentialKind::link, ""))
    all["links"].push_back(to_json(row));
  if (global.json) {
    std::cout << all.dump() << '\n';
    return;
  }
  if (all["users"].empty())
    std::cerr << "no users: who reaches the server may do everything; ream user add NAME adds an operator\n";
  for (const json& user : all["users"])
    std::cout << "user\t" << user.at("id").get<std::string>() << '\t' << user.at("name").get<std::string>()
              << '\t' << user.at("role").get<std::string>()
              << (user.at("enabled").get<bool>() ? "" : "\tdisabled") << '\n';
  for (const json& token : all["tokens"]) print_row(token, "token", names[token.at("user_id")]);
  for (const json& link : all["links"]) print_row(link, "link", names[link.at("user_id")]);
}

void make_token(const UserOptions& options, const GlobalOptions& global) {
  Office office(global);
  const access::User user = office.user(options.name);
  access::NewCredential wanted;
  wanted.user_id = user.id;
  wanted.name = options.words;
  if (!options.role.empty()) wanted.limit = access::role_from(options.role);
  if (wanted.limit && !access::may_be_limited(user.role, *wanted.limit))
    throw Error(ErrorKind::invalid_input, "'" + user.name + "' is " + access::to_text(user.role) +
                                              "; a token of theirs cannot be " + options.role);
  wanted.expires_utc =
      utc_text(std::chrono::system_clock::now() + std::chrono::hours(24) * options.expires_days);
  const access::IssuedCredential issued =
      office.access_control.credentials.issue(CredentialKind::token, wanted);
  office.note("token.add", issued.row.id, issued.row.name);
  json credential = to_json(issued.row);
  credential["secret"] = issued.secret.reveal();
  print_result(global, credential, issued.secret.reveal());
  if (!global.json) std::cerr << "until " << issued.row.expires_utc << "; it is not shown again\n";
}

void revoke(const UserOptions& options, const GlobalOptions& global) {
  Office office(global);
  access::Credentials& credentials = office.access_control.credentials;
  for (const CredentialKind kind : {CredentialKind::token, CredentialKind::link, CredentialKind::cookie})
    if (const auto row = credentials.find(options.credential, kind)) {
      credentials.revoke(row->id);
      office.note(access::to_text(kind) + ".revoke", row->id, row->name);
      print_result(global, {{"revoked", row->id}, {"kind", access::to_text(kind)}},
                   access::to_text(kind) + " " + row->id + " is revoked");
      return;
    }
  throw Error(ErrorKind::not_found,
              "no token, link or login of that id; ream user list shows tokens and links");
}

void change(const std::string& name, const access::UserChange& change, const std::string& words,
            const GlobalOptions& global) {
  Office office(global);
  const access::User user = office.access_control.users.change(office.user(name).id, change);
  office.note("user.change", user.id, user.name + ": " + words);
  print_result(global, api::user_json(user), user.name + ": " + words);
}

void set_password(const UserOptions& options, const GlobalOptions& global) {
  const std::string name = Office(global).user(options.name).name;
  access::UserChange wanted;
  wanted.password = ask_new_password(name);
  wanted.keep_tokens = options.keep_tokens;
  change(name, wanted,
         wanted.keep_tokens ? "password, tokens stay" : "password; tokens and links are revoked", global);
}

void set_role(const UserOptions& options, const GlobalOptions& global) {
  access::UserChange wanted;
  wanted.role = access::role_from(options.role);
  change(options.name, wanted, "role " + options.role, global);
}

void set_enabled(const UserOptions& options, bool enabled, const GlobalOptions& global) {
  access::UserChange wanted;
  wanted.enabled = enabled;
  change(options.name, wanted, enabled ? "enabled" : "disabled", global);
}

void remove(const UserOptions& options, const GlobalOptions& global) {
  Office office(global);
  const access::User user = office.user(options.name);
  office.access_control.users.remove(user.id);
  office.note("user.remove", user.id, user.name);
  print_result(global, {{"removed", user.id}}, user.name + " is removed");
}

void forget(const UserOptions& options, const GlobalOptions& global) {
  Office office(global);
  const access::User user = office.user(options.name);
  office.note("user.forget", user.id, "");
  const ForgetReport report =
      forget_person(*office.database, office.access_control, data_folder(global.data), user);
  if (!report.left.empty()) {
    for (const std::string& line : report.left) std::cerr << line << '\n';
    throw Error(ErrorKind::conflict, std::to_string(report.left.size()) + " places still name '" + user.name +
                                         "', who is disabled; see above, then forget again");
  }
  office.note("user.forget", user.id, "");
  print_result(global,
               {{"forgotten", user.id}, {"sessions", report.sessions}, {"audit_rows", report.audit_rows}},
               user.name + " is forgotten: " + std::to_string(report.sessions) + " sessions and " +
                   std::to_string(report.audit_rows) + " rows of the audit log are without a name");
  if (!global.json)
    std::cerr << "backups and what was downloaded still hold the name; results of jobs go within a day\n";
}

void export_user(const UserOptions& options, const GlobalOptions& global) {
  const Office office(global);
  std::cout << export_person(*office.database, office.access_control, data_folder(global.data),
                             office.user(options.name))
                   .dump(2, ' ', false, json::error_handler_t::replace)
            << '\n';
}

}  // namespace

void add_user_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<UserOptions>();
  CLI::App* command =
      app.add_subcommand("user", "Who may log in, and their tokens; a server may run meanwhile");
  command->require_subcommand(1);
  command->fallthrough();
  const auto with_name = [&](const char* word, const char* help, std::function<void()> action) {
    CLI::App* sub = command->add_subcommand(word, help);
    sub->add_option("NAME", options->name, "Name to log in with")->required();
    sub->callback(std::move(action));
    return sub;
  };
  CLI::App* adding = with_name("add", "Add a user; asks for the password, or reads a line from stdin",
                               [options, &global] { add(*options, global); });
  adding->add_option("--role", options->role, "Default: operator for the first user, then trainee")
      ->check(CLI::IsMember(account_roles));
  adding->add_option("--display-name", options->display_name, "Name to show");
  command->add_subcommand("list", "Users, tokens and viewer links")->callback([&global] { list(global); });
  CLI::App* token = with_name("token", "Make a token for a program and print it, this once",
                              [options, &global] { make_token(*options, global); });
  token->add_option("--for", options->words, "What it is for")->default_str("");
  token->add_option("--role", options->role, "At most this; default: all that the user may do")
      ->check(CLI::IsMember(token_roles));
  token->add_option("--expires-days", options->expires_days, "Days until it ends")
      ->check(CLI::Range(1, 366))
      ->capture_default_str();
  CLI::App* revoking = command->add_subcommand("revoke", "Revoke a token, a viewer link or a login at once");
  revoking->add_option("ID", options->credential, "Of ream user list")->required();
  revoking->callback([options, &global] { revoke(*options, global); });
  with_name("password", "Set a user's password; ends all logins, tokens and links", [options, &global] {
    set_password(*options, global);
  })->add_flag("--keep-tokens", options->keep_tokens, "Tokens and links stay good");
  with_name("role", "Set a user's role", [options, &global] { set_role(*options, global); })
      ->add_option("ROLE", options->role)
      ->required()
      ->check(CLI::IsMember(account_roles));
  with_name("disable", "Keep a user from logging in; ends all that they have",
            [options, &global] { set_enabled(*options, false, global); });
  with_name("enable", "Let a user log in again", [options, &global] { set_enabled(*options, true, global); });
  with_name("remove", "Remove a user; sessions stay", [options, &global] { remove(*options, global); });
  with_name("forget",
            "Remove a user and the name from sessions, trash, studies and audit log; no server may run",
            [options, &global] { forget(*options, global); });
  with_name("export", "Write all that is kept of a user to stdout, as JSON",
            [options, &global] { export_user(*options, global); });
}

}  // namespace ream::app
