#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "app/cli/commands.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/version.hpp"
#include "device/crash_guard.hpp"

namespace {

void add_commands(CLI::App& app, ream::app::GlobalOptions& global) {
  using namespace ream::app;
  app.set_version_flag("--version", ream::version_text());
  app.add_option("--data", global.data, "Data folder. Default: REAM_DATA, else ~/.local/share/ream");
  app.add_option(
         "--db", global.db,
         "Database: sqlite:FILE or postgresql://user@host:port/name. Default: REAM_DB, else ream.db in "
         "the data folder")
      ->each([](const std::string& url) { ream::app::database_url(url, {}); });
  app.add_flag("--json", global.json, "Machine-readable output on stdout");
  app.fallthrough();
  app.require_subcommand(1);
  add_serve_command(app, global);
  add_simulate_command(app, global);
  add_phantom_command(app, global);
  add_import_command(app, global);
  add_plan_command(app, global);
  add_voxelize_command(app, global);
  add_femesh_command(app, global);
  add_score_command(app, global);
  add_benchmark_command(app, global);
  add_export_command(app, global);
  add_render_command(app, global);
  add_list_command(app, global);
  add_replay_command(app, global);
  add_devices_command(app, global);
  add_audit_command(app, global);
  add_user_command(app, global);
  add_backup_command(app, global);
  add_restore_command(app, global);
  add_bench_command(app, global);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("ream: a training simulator for glenoid reaming");
  ream::app::GlobalOptions global;
  add_commands(app, global);
  for (const char* writing : {"serve", "simulate", "phantom", "import", "plan", "score", "benchmark",
                              "replay", "devices", "audit", "user", "backup", "restore"})
    app.get_subcommand(writing)->preparse_callback([](size_t) { ream::restrict_new_files_to_owner(); });
  ream::take_failed_writes_as_errors();
  ream::device::take_force_away_on_crash();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& e) {
    std::cerr << "ream: " << e.what() << "; see --help\n";
    return 2;
  } catch (const ream::Error& e) {
    std::cerr << "ream: " << e.what() << '\n';
    return ream::exit_code(e.kind());
  } catch (const std::bad_alloc&) {
    std::cerr << "ream: not enough memory; use a smaller region or less upsampling\n";
    return 1;
  } catch (const std::exception& e) {
    std::cerr << "ream: " << e.what() << '\n';
    return 1;
  }
  return 0;
}
