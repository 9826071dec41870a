#pragma once

namespace CLI {
class App;
}

namespace ream::app {

/// Lets `app` take options from a TOML file: --config FILE, else REAM_CONFIG, else none. The file has `data`
/// and `db`, and the options of `ream serve` in its section [serve]. The command line comes first, then
/// REAM_DATA and REAM_DB, then the file. Call it when all commands are there.
/// While `app` parses: Error usage for a file that is not TOML, and for a section, a key or a value that
/// nothing takes, with file and line.
void add_settings_file(CLI::App& app);

}  // namespace ream::app
