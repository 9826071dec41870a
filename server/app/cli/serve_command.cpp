#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "api/server.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/serve_options.hpp"
#include "app/open_database.hpp"
#include "app/plugin_option.hpp"
#include "app/server_address.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "core/interrupt.hpp"
#include "core/leftovers.hpp"
#include "core/log.hpp"
#include "core/page_folder.hpp"
#include "core/version.hpp"
#include "device/registry/device_registry.hpp"
#include "isolation/sandbox.hpp"
#include "openigtlink/server.hpp"
#include "session/live/session_recovery.hpp"
#include "session/service/simulation_engine.hpp"
#include "store/database_url.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

sim::Realtime realtime_from_text(const std::string& text) {
  return text == "require" ? sim::Realtime::require
         : text == "off"   ? sim::Realtime::off
                           : sim::Realtime::attempt;
}

log::Format log_format_from_text(const std::string& text) {
  return text == "text"      ? log::Format::text
         : text == "journal" ? log::Format::journal
         : text == "json"    ? log::Format::json
                             : log::Format::automatic;
}

/// An expiring link for people who only watch; empty while everybody may do everything.
std::string viewer_link(access::AccessControl& access_control, const std::string& url) {
  if (!access_control.users.any()) return {};
  access::NewCredential wanted;
  wanted.name = "the server's own, at its start";
  const auto issued = access_control.credentials.issue(access::CredentialKind::link, wanted);
  return url + "/#watch=" + issued.secret.reveal();
}

/// The viewer link goes to a person or a program that asked for it, never into a file of logs.
void print_address(const std::string& url, const openigtlink::Server* watched,
                   access::AccessControl& access_control, bool for_programs) {
  if (for_programs) {
    nlohmann::json address = {{"url", url}};
    if (watched != nullptr) address["openigtlink_port"] = watched->port();
    if (const std::string link = viewer_link(access_control, url); !link.empty())
      address["viewer_link"] = link;
    std::cout << address.dump() << std::endl;
    return;
  }
  std::cout << "ream is at " << url << "  (Ctrl-C ends it)" << std::endl;
  if (watched != nullptr)
    std::cout << "3D Slicer watches by OpenIGTLink, port " << watched->port() << std::endl;
  if (::isatty(STDOUT_FILENO) == 0) return;
  if (const std::string link = viewer_link(access_control, url); !link.empty())
    std::cout << "to watch, for 12 hours: " << link << std::endl;
}

void log_sandbox() {
  const isolation::SandboxSupport support = isolation::sandbox_support();
  const std::string words = isolation::sandbox_in_words(support);
  if (support.landlock > 0 && support.seccomp)
    log::info(words);
  else
    log::warn(words);
}

/// What is wrong with them is wrong with the settings, and does not mend itself.
void use_devices_and_models(const ServeOptions& options) {
  try {
    for (const plugin::Plugin& plugin : use_plugins(options.plugins)) log::info(plugin::in_words(plugin));
    device::device_kind(options.device);
  } catch (const Error& e) {
    throw Error(ErrorKind::usage, e.what());
  }
}

void serve(const ServeOptions& options, const GlobalOptions& global) {
  log::set_format(log_format_from_text(options.log_format));
  use_devices_and_models(options);
  session::SessionContext context;
  context.data = data_folder(global.data);
  context.server_epoch = static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(
                                                   std::chrono::system_clock::now().time_since_epoch())
                                                   .count());
  context.backend = options.backend;
  context.realtime = realtime_from_text(options.realtime);
  api::ServerOptions server_options;
  server_options.web_folder = page_folder(options.web);
  context.page = server_options.web_folder;
  if (server_options.web_folder.empty())
    log::warn("the page is not built; only the API is served (scripts/build makes the page)");
  server_options.listen = listen_options(options.address, has_users(global.db, context.data));
  std::optional<openigtlink::ServerOptions> openigtlink_options;
  if (!options.openigtlink.empty())
    openigtlink_options = openigtlink_address(options.openigtlink, options.address);
  server_options.database = open_database(global.db, context.data);
  make_data_folder(context.data);
  const auto alone = FileLock::attempt(serving_lock(context.data));
  if (!alone)
    throw Error(ErrorKind::conflict, "a server runs on " + context.data.string() +
                                         "; stop it, or choose another folder with --data");
  make_writable_folder(sessions_folder(context.data));
  if (const size_t removed = remove_leftovers(context.data); removed > 0)
    log::warn("removed " + std::to_string(removed) +
              " unfinished files and folders of a program that was ended");
  for (const std::string& line : session::recover_sessions(context.data)) log::warn(line);
  catch_interrupts();

  std::optional<openigtlink::Server> watched;
  if (openigtlink_options) {
    context.openigtlink_session = std::make_shared<openigtlink::ActiveSession>();
    watched.emplace(*openigtlink_options, context.openigtlink_session);
  }
  server_options.cases_folder = cases_folder(context.data);
  server_options.data_folder = context.data;
  server_options.sessions_folder = sessions_folder(context.data);
  server_options.engine = std::make_shared<session::SimulationEngine>(context);
  server_options.default_device = options.device;
  server_options.retention.keep_sessions_days = options.keep_sessions_days;
  server_options.retention.clock_file = context.data / "clock.json";
  server_options.retention.keep_deleted_days = options.keep_deleted_days;
  server_options.retention.max_at_once_percent = options.delete_at_once_percent;
  server_options.sessions.unstarted = std::chrono::minutes(options.end_unstarted_minutes);
  if (options.end_unstarted_minutes == 0) server_options.sessions.unstarted.reset();
  server_options.sessions.paused = std::chrono::minutes(options.end_paused_minutes);
  if (options.end_paused_minutes == 0) server_options.sessions.paused.reset();
  server_options.make_demo_case = true;
  api::Server server(std::move(server_options));
  server.start();

  if (const std::string warning = data_folder_warning(context.data); !warning.empty()) log::warn(warning);
  log::info(version_text() + ", data folder " + context.data.string() + ", database " +
            store::parse_database_url(database_url(global.db, context.data)).shown + ", backend " +
            options.backend);
  log_sandbox();
  print_address(server_url(options.address, server.port()), watched ? &*watched : nullptr,
                server.access_control(), global.json);
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  log::info("stopping: sessions end without force, recordings are closed");
  server.stop();
}

}  // namespace

std::shared_ptr<const ServeOptions> add_serve_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ServeOptions>();
  CLI::App* command = app.add_subcommand("serve", "Serve the page, the API and live sessions");
  add_serve_options(*command, *options);
  command->callback([options, &global] { serve(*options, global); });
  return options;
}

}  // namespace ream::app
