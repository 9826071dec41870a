#include "app/restore_backup.hpp"

#include <algorithm>
#include <chrono>

#include "app/backup_manifest.hpp"
#include "app/data_snapshot.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "core/folder_listing.hpp"
#include "core/temporary_file.hpp"
#include "core/utc.hpp"
#include "store/table_files.hpp"
#include "store/zip_archive.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;

constexpr double unpacked_share = 0.8;

uint64_t files_below(const fs::path& folder) {
  uint64_t count = 0;
  for (const fs::path& path : paths_in(folder)) {
    const fs::file_type type = fs::symlink_status(path).type();
    if (type == fs::file_type::regular) ++count;
    if (type == fs::file_type::directory) count += files_below(path);
  }
  return count;
}

bool holds_anything(const fs::path& folder) {
  std::error_code failed;
  return fs::exists(folder, failed) && !fs::is_empty(folder, failed);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What a restore would replace: folders of the data folder, and tables.
struct Present {
  std::vector<std::string> folders, tables;
  bool anything() const { return !folders.empty() || !tables.empty(); }
};

Present look(store::Database& database, const fs::path& data) {
  Present present;
  for (const std::string& folder : kept_folders(data))
    if (holds_anything(data / folder)) present.folders.push_back(folder);
  present.tables = store::filled_tables(database);
  return present;
}

void require_empty(const Present& present, const std::string& database, const fs::path& data) {
  if (!present.anything()) return;
  const std::string there = !present.folders.empty()
                                ? data.string() + " holds " + listed(present.folders)
                                : "the database " + database + " holds " + listed(present.tables);
  throw Error(ErrorKind::conflict,
              there +
                  "; restore into an empty data folder and database (--data, --db), or with "
                  "--force, which moves aside what is there");
}

/// Folders that change places, and go back unless they are to stay.
class Moves {
 public:
  Moves() = default;
  ~Moves() {
    std::error_code ignored;
    for (auto move = done_.rbegin(); move != done_.rend(); ++move)
      fs::rename(move->second, move->first, ignored);
  }
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;

  void move(const fs::path& from, const fs::path& to) {
    std::error_code failed;
    fs::remove(to, failed);  // an empty folder
    fs::rename(from, to, failed);
    if (failed)
      throw Error(ErrorKind::io,
                  "cannot move " + from.string() + " to " + to.string() + ": " + failed.message());
    done_.emplace_back(from, to);
  }
  bool none() const { return done_.empty(); }
  void stay() { done_.clear(); }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

/// Where what is there goes: folders later, rows now.
fs::path made_aside(store::Database& database, const Present& present, const fs::path& data) {
  if (!present.anything()) return {};
  std::string utc = utc_text(std::chrono::system_clock::now());
  std::replace(utc.begin(), utc.end(), ':', '-');
  const fs::path aside = data / (moved_aside + utc);
  std::error_code failed;
  fs::create_directories(aside / "tables", failed);
  if (failed) throw Error(ErrorKind::io, "cannot make " + aside.string() + ": " + failed.message());
  store::write_table_files(database, aside / "tables");
  return aside;
}

void put_in_place(const fs::path& unpacked, const fs::path& data, const fs::path& aside, Moves& moves) {
  if (!moves.none()) return;
  std::vector<std::string> names = kept_folders(data);
  for (const std::string& name : names)
    if (holds_anything(data / name)) moves.move(data / name, aside / name);
  for (const std::string& name : kept_folders(unpacked)) moves.move(unpacked / name, data / name);
  if (moves.none()) return;
  if (!aside.empty()) sync_folder(aside);  // first, so that what is there is never nowhere
  sync_folder(data);
}

/// Rows and folders together, or neither.
void replace(store::Database& database, const fs::path& unpacked, const std::vector<store::TableFile>& tables,
             const fs::path& data, const fs::path& aside, bool keep_tokens, const Progress& progress) {
  Moves moves;
  const auto put = [&] {
    put_in_place(unpacked / "data", data, aside, moves);
    progress(1.0, "keeping it");
  };
  store::read_table_files(database, unpacked / "tables", tables, put, progress,
                          keep_tokens ? store::OldCredentials::tokens : store::OldCredentials::none);
  moves.stay();
}

RestoreReport report_of(const BackupManifest& manifest, const fs::path& data, const fs::path& aside) {
  RestoreReport report;
  report.aside = aside;
  for (const std::string& name : kept_folders(data)) report.counts[name] = paths_in(data / name).size();
  for (const store::TableFile& table : manifest.tables) report.rows += table.rows;
  return report;
}

}  // namespace

void require_backup(const fs::path& file) {
  const auto names = store::zip_names(file);
  if (std::find(names.begin(), names.end(), "backup.json") == names.end())
    throw Error(ErrorKind::invalid_input, file.string() + " is no backup of ream: it holds no backup.json");
}

RestoreReport restore_backup(store::Database& database, const fs::path& data, const fs::path& file,
                             const RestoreOptions& options, const Progress& progress) {
  require_backup(file);
  const Present present = look(database, data);
  if (!options.force) require_empty(present, database.name(), data);
  const auto alone = FileLock::attempt(serving_lock(data));
  if (!alone)
    throw Error(ErrorKind::conflict, "a server runs on " + data.string() + "; stop it, then restore");

  const TemporaryFolder scratch(data / ".restore");
  constexpr uint64_t any = INT64_MAX;
  store::unpack_zip(file, scratch.path(), {any, any, false, true}, part_of(progress, 0.0, unpacked_share));
  const BackupManifest manifest = read_manifest(scratch.path() / "backup.json", file);
  if (const uint64_t files = files_below(scratch.path() / "data"); files != manifest.files)
    throw Error(ErrorKind::invalid_input, file.string() + " holds " + std::to_string(files) +
                                              " files of the " + std::to_string(manifest.files) +
                                              " that it should; it is not whole");
  sync_tree(scratch.path());

  const fs::path aside = made_aside(database, present, data);
  try {
    replace(database, scratch.path(), manifest.tables, data, aside, options.keep_tokens,
            part_of(progress, unpacked_share, 1.0));
  } catch (...) {
    std::error_code ignored;
    if (!aside.empty()) fs::remove_all(aside / "tables", ignored);
    if (!aside.empty()) fs::remove(aside, ignored);
    throw;
  }
  return report_of(manifest, data, aside);
}

}  // namespace ream::app
