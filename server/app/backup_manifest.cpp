#include "app/backup_manifest.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/json.hpp"
#include "core/json_reader.hpp"
#include "store/migrations.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* format = "ream backup";
constexpr int revision = 1;

[[noreturn]] void refuse(const fs::path& archive, const std::string& why) {
  throw Error(ErrorKind::invalid_input, archive.string() + " is no backup that can be restored: " + why);
}

bool is_known(int number) {
  const auto& known = store::migrations();
  return std::any_of(known.begin(), known.end(), [&](const auto& step) { return step.number == number; });
}

BackupManifest manifest_from(const json& value, const fs::path& archive) {
  JsonReader reader(value, archive.string() + ": backup.json");
  BackupManifest manifest;
  reader.text("format");
  reader.integer("revision");
  manifest.made_utc = reader.text("made_utc");
  manifest.build = reader.text("build");
  manifest.files = reader.unsigned_integer("files");
  for (JsonReader& table : reader.objects("tables")) {
    manifest.tables.push_back({table.text("table"), table.unsigned_integer("rows")});
    table.finish();
  }
  for (const json& number : value.at("migrations"))
    if (!number.is_number_integer() || !is_known(number.get<int>()))
      refuse(archive, "it was made by a newer version (" + manifest.build + "); update this one");
  return manifest;
}

}  // namespace

void write_manifest(const BackupManifest& manifest, const fs::path& file) {
  json tables = json::array(), migrations = json::array();
  for (const store::TableFile& table : manifest.tables)
    tables.push_back({{"table", table.table}, {"rows", table.rows}});
  for (const store::Migration& step : store::migrations()) migrations.push_back(step.number);
  const json value = {{"format", format},
                      {"revision", revision},
                      {"made_utc", manifest.made_utc},
                      {"build", manifest.build},
                      {"migrations", std::move(migrations)},
                      {"tables", std::move(tables)},
                      {"files", manifest.files}};
  write_json_file(file, value);
}

BackupManifest read_manifest(const fs::path& file, const fs::path& archive) {
  const json value = read_json_file(file);
  if (!value.is_object() || value.value("format", json()) != format) refuse(archive, "backup.json says so");
  if (value.value("revision", json()) != revision)
    refuse(archive, "its format is that of a newer version; update this one");
  if (!value.contains("migrations") || !value["migrations"].is_array())
    refuse(archive, "backup.json has no 'migrations'");
  return manifest_from(value, archive);
}

}  // namespace ream::app
