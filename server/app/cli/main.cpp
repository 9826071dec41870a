#include <CLI/CLI.hpp>
#include <build_commit.hpp>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/cli/commands.hpp"
#include "app/open_database.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/process_memory.hpp"
#include "core/version.hpp"
#include "device/crash_guard.hpp"

namespace {

/// "ream 0.1.0 (0123456789ab, g++ 12.2.0, release)"; without the commit where the sources came without git.
std::string version_line() {
  const std::string commit = REAM_BUILD_COMMIT;
  return ream::version_text() + " (" + (commit.empty() ? "" : commit + ", ") +
         "g++ " __VERSION__ ", " REAM_BUILD_TYPE ")";
}

void add_commands(CLI::App& app, ream::app::GlobalOptions& global) {
  using namespace ream::app;
  app.set_version_flag("--version", version_line());
  app.add_option("--data", global.data, "Data folder. Default: REAM_DATA, else ~/.local/share/ream");
  app.add_option(
         "--db", global.db,
         "Database: sqlite:FILE or postgresql://user@host:port/name. Default: REAM_DB, else ream.db in "
         "the data folder")
      ->each([](const std::string& url) { ream::app::database_url(url, {}); });
  app.add_flag("--json", global.json, "Machine-readable output on stdout");
  app.fallthrough();
  app.require_subcommand(1);
  add_doctor_command(app, global, add_serve_command(app, global));
  add_simulate_command(app, global);
  add_phantom_command(app, global);
  add_import_command(app, global);
  add_plan_command(app, global);
  add_voxelize_command(app, global);
  add_femesh_command(app, global);
  add_solve_command(app, global);
  add_score_command(app, global);
  add_benchmark_command(app, global);
  add_export_command(app, global);
  add_codebook_command(app, global);
  add_render_command(app, global);
  add_list_command(app, global);
  add_replay_command(app, global);
  add_devices_command(app, global);
  add_plugin_command(app, global);
  add_audit_command(app, global);
  add_user_command(app, global);
  add_backup_command(app, global);
  add_restore_command(app, global);
  add_verify_release_command(app, global);
  add_bench_command(app, global);
  add_completion_command(app);
  add_settings_file(app);
}

/// What was wrong with the command line, or with a settings file.
std::string usage_message(const CLI::App& app, const std::vector<std::string>& arguments,
                          const CLI::ParseError& error) {
  const std::string unknown = ream::app::unknown_argument(app, arguments);
  if (!unknown.empty()) return unknown + (unknown.back() == '?' ? "" : "; see --help");
  const auto file = app.get_config_ptr()->as<std::string>();
  return std::string(error.what()) + "; see --help" + (file.empty() ? "" : " and " + file);
}

/// One line on stderr; with --json an object. Returns the exit code.
int fail(ream::ErrorKind kind, const std::string& message, bool for_programs) {
  if (for_programs)
    std::cerr << nlohmann::json{{"error", message}, {"exit_code", ream::exit_code(kind)}}.dump(
                     -1, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  else
    std::cerr << "ream: " << message << '\n';
  return ream::exit_code(kind);
}

/// Returns the exit code.
int run(int argc, char** argv, bool for_programs) {
  CLI::App app("ream: a training simulator for glenoid reaming");
  ream::app::GlobalOptions global;
  add_commands(app, global);
  for (const char* writing :
       {"serve", "simulate", "phantom", "import", "plan", "score", "benchmark", "replay", "export", "render",
        "femesh", "solve", "devices", "audit", "user", "backup", "restore"})
    app.get_subcommand(writing)->preparse_callback([](size_t) { ream::restrict_new_files_to_owner(); });
  ream::take_failed_writes_as_errors();
  ream::device::take_force_away_on_crash();
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& e) {
    return fail(ream::ErrorKind::usage, usage_message(app, {argv + 1, argv + argc}, e), for_programs);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ream::keep_memory_reserve();
  bool for_programs = false;
  for (int i = 1; i < argc; ++i) for_programs |= std::string_view(argv[i]) == "--json";
  try {
    return run(argc, argv, for_programs);
  } catch (const ream::Error& e) {
    return fail(e.kind(), e.what(), for_programs);
  } catch (const std::bad_alloc&) {
    return fail(ream::ErrorKind::unavailable, "not enough memory; use a smaller region or less upsampling",
                for_programs);
  } catch (const std::exception& e) {
    return fail(ream::ErrorKind::io, e.what(), for_programs);
  }
}
