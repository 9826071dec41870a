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
#include "app/open_database.hpp"
#include "app/server_address.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "core/interrupt.hpp"
#include "core/leftovers.hpp"
#include "core/log.hpp"
#include "device/registry/device_registry.hpp"
#include "isolation/sandbox.hpp"
#include "openigtlink/server.hpp"
#include "session/live/session_recovery.hpp"
#include "session/service/simulation_engine.hpp"
#include "store/database_url.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

constexpr int max_days = 36500, max_minutes = 7 * 24 * 60;

struct ServeOptions {
  ServerAddress address;
  std::string openigtlink;  ///< as on the command line; empty: not wanted
  fs::path web;
  std::string backend = "auto", realtime = "try", device = "script";
  std::optional<int> keep_sessions_days;
  int keep_deleted_days = 30, end_unstarted_minutes = 10;
  int delete_at_once_percent = 50;
};

/// The built page: --web, else web/ beside the program's folder, else web/dist of the source tree it was
/// built in.
fs::path web_folder(const fs::path& chosen) {
  std::error_code failed;
  if (!chosen.empty()) {
    if (!fs::is_regular_file(chosen / "index.html", failed))
      throw Error(ErrorKind::not_found,
                  "no index.html in " + chosen.string() + "; build the page or correct --web");
    return chosen;
  }
  const fs::path beside = fs::read_symlink("/proc/self/exe", failed).parent_path().parent_path();
  for (const fs::path& folder : {beside / "share/ream/web", beside / "web/dist"})
    if (fs::is_regular_file(folder / "index.html", failed)) return folder;
  log::warn("the page is not built; only the API is served (scripts/build makes the page)");
  return {};
}

sim::Realtime realtime_from_text(const std::string& text) {
  return text == "require" ? sim::Realtime::require
         : text == "off"   ? sim::Realtime::off
                           : sim::Realtime::attempt;
}

std::vector<std::string> device_names() {
  std::vector<std::string> names;
  for (const device::DeviceKind& kind : device::device_kinds()) names.push_back(kind.name);
  return names;
}

/// Makes nothing where there is no database yet.
bool has_users(const std::string& db, const fs::path& data) {
  const store::DatabaseUrl url = store::parse_database_url(database_url(db, data));
  std::error_code failed;
  if (!url.postgresql && !fs::exists(url.file, failed)) return false;
  return access::AccessControl(*open_database(db, data)).users.any();
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

void serve(const ServeOptions& options, const GlobalOptions& global) {
  session::SessionContext context;
  context.data = data_folder(global.data);
  context.server_epoch = static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(
                                                   std::chrono::system_clock::now().time_since_epoch())
                                                   .count());
  context.backend = options.backend;
  context.realtime = realtime_from_text(options.realtime);
  api::ServerOptions server_options;
  server_options.web_folder = web_folder(options.web);
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
  server_options.retention.keep_deleted_days = options.keep_deleted_days;
  server_options.retention.max_at_once_percent = options.delete_at_once_percent;
  server_options.sessions.unstarted = std::chrono::minutes(options.end_unstarted_minutes);
  if (options.end_unstarted_minutes == 0) server_options.sessions.unstarted.reset();
  server_options.make_demo_case = true;
  api::Server server(std::move(server_options));
  server.start();

  if (const std::string warning = data_folder_warning(context.data); !warning.empty()) log::warn(warning);
  log_sandbox();
  print_address(server_url(options.address, server.port()), watched ? &*watched : nullptr,
                server.access_control(), global.json);
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  log::info("stopping: sessions end without force, recordings are closed");
  server.stop();
}

}  // namespace

void add_serve_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ServeOptions>();
  ServerAddress& address = options->address;
  CLI::App* command = app.add_subcommand("serve", "Serve the page, the API and live sessions");
  command->add_option("--host", address.host, "Address to listen on; others than loopback need users and TLS")
      ->capture_default_str();
  command->add_option("--port", address.port, "Port; 0 takes any free one")->capture_default_str();
  command->add_option("--public-name", address.public_names,
                      "Name by which others reach this machine; several may be given");
  command->add_option("--tls-cert", address.certificate_chain,
                      "The server's certificate with its chain, PEM");
  command->add_option("--tls-key", address.key, "Its key, PEM");
  command->add_option("--trusted-proxy", address.trusted_proxies,
                      "Proxy in front of this server, ADDRESS[/BITS], whose Forwarded or X-Forwarded-For and "
                      "-Proto say who asks; several may be given");
  command->add_flag("--insecure", address.insecure,
                    "Let others log in without TLS, where something else encrypts");
  command->add_option("--openigtlink", options->openigtlink,
                      "[HOST:]PORT where 3D Slicer and others can watch the newest session; HOST as --host");
  command->add_option("--web", options->web, "Folder of the built page");
  command->add_option("--backend", options->backend, "auto, cpu, opencl or opencl:N")->capture_default_str();
  command->add_option("--device", options->device, "Device of sessions that name none")
      ->check(CLI::IsMember(device_names()))
      ->capture_default_str();
  command->add_option("--realtime", options->realtime, "Real-time priority of the haptic loop")
      ->check(CLI::IsMember({"require", "try", "off"}))
      ->capture_default_str();
  command
      ->add_option("--keep-sessions-days", options->keep_sessions_days,
                   "Delete sessions that are older; default: never")
      ->check(CLI::Range(1, max_days));
  command
      ->add_option("--keep-deleted-days", options->keep_deleted_days,
                   "Keep deleted sessions for so long, so that they can be restored; 0: not at all")
      ->check(CLI::Range(0, max_days))
      ->capture_default_str();
  command
      ->add_option("--delete-at-once-percent", options->delete_at_once_percent,
                   "Delete nothing by age while more than this share would go at once; 100: no limit")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--end-unstarted-minutes", options->end_unstarted_minutes,
                   "End sessions that nobody has started for so long; 0: never")
      ->check(CLI::Range(0, max_minutes))
      ->capture_default_str();
  command->callback([options, &global] { serve(*options, global); });
}

}  // namespace ream::app
