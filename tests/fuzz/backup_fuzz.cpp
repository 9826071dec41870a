// What `ream restore` reads of a backup: its manifest, and the rows of the tables.
#include <array>
#include <filesystem>

#include "app/backup_manifest.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/temporary_file.hpp"
#include "fuzz_input.hpp"
#include "store/table_files.hpp"

namespace ream::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::array tables = {"users", "sessions", "studies", "credentials", "audit"};

struct Place {
  TemporaryFolder folder{fs::temp_directory_path() / "ream-fuzz-backup"};
  store::Database database{"sqlite:" + (folder.path() / "fuzz.db").string()};
};

Place& place() {
  static Place one;
  return one;
}

void read_manifest(std::string_view text) {
  const fs::path file = place().folder.path() / "backup.json";
  write_file_atomically(file, text);
  const app::BackupManifest manifest = app::read_manifest(file, "backup.zip");
  app::write_manifest(manifest, file);
  require(app::read_manifest(file, "backup.zip").files == manifest.files,
          "a manifest that was written is read as something else");
}

uint64_t rows_of(std::string_view text) {
  uint64_t lines = 0;
  for (const char c : text) lines += c == '\n';
  return lines + (!text.empty() && text.back() != '\n') - (text.empty() ? 0 : 1);
}

/// What is taken is what is written again; what is refused leaves the tables as they were.
void read_rows(const std::string& table, std::string_view text) {
  Place& here = place();
  const fs::path folder = here.folder.path();
  const auto before = store::filled_tables(here.database);
  write_file_atomically(folder / (table + ".jsonl"), text);
  try {
    store::read_table_files(here.database, folder, {{table, rows_of(text)}}, [] {});
  } catch (const Error&) {
    require(store::filled_tables(here.database) == before, "a refused table has changed others");
    return;
  }
  for (const store::TableFile& written : store::write_table_files(here.database, folder))
    if (written.table == table)
      require(written.rows == rows_of(text), "as many rows as were read are not written");
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  fuzz::Input input(data, size);
  const uint8_t kind = input.byte();
  try {
    if (kind % 4 == 0)
      fuzz::read_manifest(input.rest());
    else
      fuzz::read_rows(fuzz::tables[kind % fuzz::tables.size()], input.rest());
  } catch (const Error&) {
  }
  return 0;
}
