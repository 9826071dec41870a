#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "core/file.hpp"
#include "store/credential_table.hpp"
#include "store/dialect.hpp"
#include "store/feel_table.hpp"
#include "store/idempotency_table.hpp"
#include "store/migrations.hpp"
#include "store/rating_table.hpp"
#include "store/session_index.hpp"
#include "store/sql.hpp"
#include "store/study_table.hpp"
#include "store/table_files.hpp"
#include "store/user_table.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

namespace fs = std::filesystem;

/// Databases as earlier versions left them: golden/after_NNN.sql, in the words of migrations. They are never
/// changed; each new step gets a file of its own.
std::vector<fs::path> golden_files() {
  std::vector<fs::path> files;
  for (const auto& entry :
       fs::directory_iterator(fs::path(test::source_folder()) / "tests/integration/store/golden"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

template <typename Store>
class GoldenDatabasesTest : public test::TestDatabase<Store> {
 protected:
  /// The database is as the file says, and nothing else.
  void become(const fs::path& file) {
    const std::string text = read_text_file(file);
    this->database().run([&](Sql& sql) {
      auto names = table_names();
      names.insert(names.begin(), "migrations");
      for (auto name = names.rbegin(); name != names.rend(); ++name) sql << "DROP TABLE IF EXISTS " + *name;
      for (size_t from = 0, end = text.find(";\n"); end != std::string::npos; end = text.find(";\n", from)) {
        sql << in_dialect(sql, text.substr(from, end - from));
        from = end + 2;
      }
    });
  }
};
TYPED_TEST_SUITE(GoldenDatabasesTest, test::BothStores, test::StoreNames);

/// All rows of all tables, as files.
std::map<std::string, std::string> rows_of(Database& database) {
  const test::TemporaryFolder folder;
  std::map<std::string, std::string> rows;
  for (const TableFile& file : write_table_files(database, folder.path()))
    rows[file.table] = read_text_file(folder.path() / (file.table + ".jsonl"));
  return rows;
}

/// The way back to an older version: a SQLite file is kept as that version left the database.
TYPED_TEST(GoldenDatabasesTest, AreKeptBeforeTheyAreBroughtUpToDate) {
  const test::TemporaryFolder folder;
  for (size_t i = 1; i + 1 < migrations().size(); ++i) {
    this->become(golden_files()[i]);
    const size_t missing = migrations().size() - i - 1;
    ASSERT_EQ(missing_migrations(this->url()), missing);
    const fs::path kept = keep_before_migration(this->url(), folder.path());
    EXPECT_EQ(missing_migrations(this->url()), missing) << "keeping it has changed it";
    const std::string next = std::to_string(1000 + migrations()[i + 1].number).substr(1);
    EXPECT_TRUE(kept.string().ends_with(".before-" + next)) << kept;
    for (const auto& entry : fs::directory_iterator(kept.parent_path()))
      EXPECT_FALSE(entry.path().filename().string().starts_with(kept.filename().string() + ".")) << entry;
    EXPECT_FALSE(fs::exists(kept.string() + "-wal"));
    EXPECT_EQ(missing_migrations("sqlite:" + kept.string()), missing);
    EXPECT_EQ(keep_before_migration(this->url(), folder.path()), fs::path())
        << "a copy that is there was replaced";
    const auto upgraded = this->open_again();
    EXPECT_EQ(missing_migrations(this->url()), 0u);
    EXPECT_EQ(keep_before_migration(this->url(), folder.path()), fs::path());
    Database back("sqlite:" + kept.string());
    EXPECT_EQ(rows_of(back), rows_of(*upgraded));
  }
}

TYPED_TEST(GoldenDatabasesTest, ThereIsOneForEachStep) {
  std::vector<int> steps, files;
  for (const Migration& step : migrations()) steps.push_back(step.number);
  for (const fs::path& file : golden_files()) files.push_back(std::stoi(file.stem().string().substr(6)));
  EXPECT_EQ(files, steps);
}

TYPED_TEST(GoldenDatabasesTest, AreOpenedWithAllTheirRows) {
  for (const fs::path& file : golden_files()) {
    SCOPED_TRACE(file.filename());
    const int step = std::stoi(file.stem().string().substr(6));
    this->become(file);
    const auto today = this->open_again();
    const auto session = SessionIndex(*today).get("abcd2345");
    ASSERT_TRUE(session);
    EXPECT_EQ(session->trainee, "Anna");
    EXPECT_EQ(session->points.has_value(), step >= 40);
    if (step < 10) continue;
    EXPECT_EQ(UserTable(*today, "operator").find_by_name("anna")->id, "u1");
    const CredentialTable credentials(*today);
    EXPECT_TRUE(credentials.find("t1"));
    EXPECT_EQ(credentials.find("l1").has_value(), step >= 50) << "nobody's links end with step 50";
    EXPECT_TRUE(step < 20 || IdempotencyTable(*today).find("u1", "k1"));
    if (step < 30) continue;
    EXPECT_EQ(StudyTable(*today).codes_of("u1").at("st1"), "P01");
    EXPECT_EQ(StudyTable(*today).participant("st1", "P01")->arm, step < 60 ? "" : "control");
    EXPECT_EQ(RatingTable(*today).ratings("st1").size(), step < 60 ? 0u : 1u);
    EXPECT_EQ(FeelTable(*today).answers("st1").size(), step < 70 ? 0u : 1u);
  }
}

}  // namespace
}  // namespace ream::store
