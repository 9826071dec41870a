#include "app/backup.hpp"

#include <chrono>

#include "app/backup_manifest.hpp"
#include "app/data_snapshot.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/leftovers.hpp"
#include "core/temporary_file.hpp"
#include "core/utc.hpp"
#include "core/version.hpp"
#include "store/table_files.hpp"
#include "store/zip_archive.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

constexpr double packing_begins = 0.1;

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw Error(ErrorKind::io, "cannot make " + folder.string() + ": " + failed.message());
}

/// In a folder of its own until it is whole, where nobody else may look at it.
void write_private_zip(const fs::path& file, const std::vector<store::ArchiveEntry>& entries,
                       const Progress& progress) {
  const TemporaryFolder folder(unfinished_beside(file));
  const fs::path made = folder.path() / "backup.zip";
  store::write_zip(made, entries, progress);
  std::error_code failed;
  fs::permissions(made, fs::perms::owner_read | fs::perms::owner_write, failed);
  if (!failed) fs::rename(made, file, failed);
  if (failed) throw Error(ErrorKind::io, "cannot write " + file.string() + ": " + failed.message());
  sync_folder(fs::absolute(file).parent_path());
}

}  // namespace

BackupReport write_backup(store::Database& database, const fs::path& data, const fs::path& file,
                          const Progress& progress) {
  const TemporaryFolder scratch(data / ".backup");
  const fs::path tables = scratch.path() / "tables", links = scratch.path() / "data";
  make_folder(tables);
  make_folder(links);
  progress(0.0, "reading the database");
  BackupManifest manifest;
  manifest.made_utc = utc_text(std::chrono::system_clock::now());
  manifest.build = version_text();
  manifest.tables = store::write_table_files(database, tables);
  progress(packing_begins / 2, "looking at sessions and cases");
  const DataSnapshot snapshot = snapshot_data(data, links);
  manifest.files = snapshot.files.size();
  write_manifest(manifest, scratch.path() / "backup.json");

  std::vector<store::ArchiveEntry> entries{{scratch.path() / "backup.json", "backup.json"}};
  for (const store::TableFile& table : manifest.tables)
    entries.push_back({tables / (table.table + ".jsonl"), "tables/" + table.table + ".jsonl"});
  for (const store::ArchiveEntry& held : snapshot.files)
    entries.push_back({held.file, "data/" + held.name, held.bytes});
  write_private_zip(file, entries, part_of(progress, packing_begins, 1.0));

  BackupReport report{snapshot.counts, 0, snapshot.live};
  for (const store::TableFile& table : manifest.tables) report.rows += table.rows;
  return report;
}

}  // namespace ream::app
