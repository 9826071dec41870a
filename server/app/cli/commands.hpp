#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ream::app {

/// Options of every command.
struct GlobalOptions {
  bool json = false;           ///< machine-readable output on stdout
  std::filesystem::path data;  ///< --data; empty: see data_folder()
  std::string db;              ///< --db as given; see open_database()
};

struct ServeOptions;

/// Each adds its sub-command; `options` must outlive `app`. The work is done in the command's callback and
/// throws ream::Error.
void add_phantom_command(CLI::App& app, GlobalOptions& options);
void add_import_command(CLI::App& app, GlobalOptions& options);
void add_plan_command(CLI::App& app, GlobalOptions& options);
void add_voxelize_command(CLI::App& app, GlobalOptions& options);
void add_femesh_command(CLI::App& app, GlobalOptions& options);
void add_solve_command(CLI::App& app, GlobalOptions& options);
void add_simulate_command(CLI::App& app, GlobalOptions& options);
/// Returns what the server is asked for, which is known once `app` has parsed.
std::shared_ptr<const ServeOptions> add_serve_command(CLI::App& app, GlobalOptions& options);
void add_doctor_command(CLI::App& app, GlobalOptions& options, std::shared_ptr<const ServeOptions> serve);
void add_score_command(CLI::App& app, GlobalOptions& options);
void add_benchmark_command(CLI::App& app, GlobalOptions& options);
void add_export_command(CLI::App& app, GlobalOptions& options);
void add_codebook_command(CLI::App& app, GlobalOptions& options);
void add_render_command(CLI::App& app, GlobalOptions& options);
void add_list_command(CLI::App& app, GlobalOptions& options);
void add_replay_command(CLI::App& app, GlobalOptions& options);
void add_devices_command(CLI::App& app, GlobalOptions& options);
void add_plugin_command(CLI::App& app, GlobalOptions& options);
void add_audit_command(CLI::App& app, GlobalOptions& options);
void add_user_command(CLI::App& app, GlobalOptions& options);
void add_backup_command(CLI::App& app, GlobalOptions& options);
void add_restore_command(CLI::App& app, GlobalOptions& options);
void add_verify_release_command(CLI::App& app, GlobalOptions& options);
void add_bench_command(CLI::App& app, GlobalOptions& options);
/// Knows all commands that `app` has when it runs.
void add_completion_command(CLI::App& app);

/// Lets `app` take options from a TOML file: --config FILE, else REAM_CONFIG, else none. The file has `data`
/// and `db`, and the options of `ream serve` in its section [serve]. The command line comes first, then
/// REAM_DATA and REAM_DB, then the file. Call it when all commands are there.
/// While `app` parses: Error usage for a file that is not TOML, and for a section, a key or a value that
/// nothing takes, with file and line.
void add_settings_file(CLI::App& app);

/// Commands directly below `command`.
std::vector<const CLI::App*> commands_below(const CLI::App& command);
/// Options that it takes, those of the commands above it among them: "--case".
std::vector<std::string> option_names(const CLI::App& command);

/// One sentence about the first argument that is no command or option of `app`, with the nearest that is one;
/// empty when all are known. `arguments`: without the program's name.
std::string unknown_argument(const CLI::App& app, const std::vector<std::string>& arguments);

}  // namespace ream::app
