#include "app/cli/serve_options.hpp"

#include <CLI/CLI.hpp>

#include "app/plugin_option.hpp"
#include "core/error.hpp"
#include "device/registry/device_registry.hpp"

namespace ream::app {
namespace {

constexpr int max_days = 36500, max_minutes = 7 * 24 * 60;

std::string device_names() {
  std::string names;
  for (const device::DeviceKind& kind : device::device_kinds())
    names += (names.empty() ? "" : ", ") + kind.name;
  return names;
}

}  // namespace

void add_serve_options(CLI::App& command, ServeOptions& options) {
  ServerAddress& address = options.address;
  command.add_option("--host", address.host, "Address to listen on; others than loopback need users and TLS")
      ->capture_default_str();
  command.add_option("--port", address.port, "Port; 0 takes any free one")->capture_default_str();
  command.add_option("--public-name", address.public_names,
                     "Name by which others reach this machine; several may be given");
  command.add_option("--tls-cert", address.certificate_chain, "The server's certificate with its chain, PEM");
  command.add_option("--tls-key", address.key, "Its key, PEM");
  command.add_option("--trusted-proxy", address.trusted_proxies,
                     "Proxy in front of this server, ADDRESS[/BITS], whose Forwarded or X-Forwarded-For and "
                     "-Proto say who asks; several may be given");
  command.add_flag("--insecure", address.insecure,
                   "Let others log in without TLS, where something else encrypts");
  command.add_option("--openigtlink", options.openigtlink,
                     "[HOST:]PORT where 3D Slicer and others can watch the newest session; HOST as --host");
  command.add_option("--web", options.web, "Folder of the built page");
  command.add_option("--backend", options.backend, "auto, cpu, opencl or opencl:N")->capture_default_str();
  command
      .add_option("--device", options.device,
                  "Device of sessions that name none: " + device_names() + ", or a plug-in's")
      ->capture_default_str();
  add_plugin_option(command, options.plugins);
  command.add_option("--realtime", options.realtime, "Real-time priority of the haptic loop")
      ->check(CLI::IsMember({"require", "try", "off"}))
      ->capture_default_str();
  command
      .add_option("--keep-sessions-days", options.keep_sessions_days,
                  "Delete sessions that are older; default: never")
      ->check(CLI::Range(1, max_days));
  command
      .add_option("--keep-deleted-days", options.keep_deleted_days,
                  "Keep deleted sessions for so long, so that they can be restored; 0: not at all")
      ->check(CLI::Range(0, max_days))
      ->capture_default_str();
  command
      .add_option("--delete-at-once-percent", options.delete_at_once_percent,
                  "Delete nothing by age while more than this share would go at once; 100: no limit")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      .add_option("--end-unstarted-minutes", options.end_unstarted_minutes,
                  "End sessions that nobody has started for so long; 0: never")
      ->check(CLI::Range(0, max_minutes))
      ->capture_default_str();
  command
      .add_option("--end-paused-minutes", options.end_paused_minutes,
                  "End sessions that have been paused for so long, also without their device; 0: never")
      ->check(CLI::Range(0, max_minutes))
      ->capture_default_str();
  command
      .add_option("--log-format", options.log_format,
                  "Form of log lines; auto: journal where systemd reads them, else text")
      ->check(CLI::IsMember({"auto", "text", "journal", "json"}))
      ->capture_default_str();
}

}  // namespace ream::app
