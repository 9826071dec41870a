#include "store/migrations.hpp"

#include "store/session_index.hpp"
#include "store/sql.hpp"
#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

template <typename Store>
class MigrationsTest : public test::TestDatabase<Store> {
 protected:
  int count_steps() {
    return this->database().read([](Sql& sql) {
      int count = 0;
      sql << "SELECT count(*) FROM migrations", into(count);
      return count;
    });
  }
};
TYPED_TEST_SUITE(MigrationsTest, test::BothStores, test::StoreNames);

TYPED_TEST(MigrationsTest, RunOnceEach) {
  const int steps = static_cast<int>(migrations().size());
  EXPECT_EQ(this->count_steps(), steps);
  const auto again = this->open_again();
  EXPECT_EQ(this->count_steps(), steps);
}

TYPED_TEST(MigrationsTest, AreCountedWithoutRunningThem) {
  EXPECT_EQ(missing_migrations(this->url()), 0u);
  this->database().run([](Sql& sql) { sql << "DELETE FROM migrations WHERE number = 1"; });
  EXPECT_EQ(missing_migrations(this->url()), 1u);
  EXPECT_EQ(missing_migrations(this->url()), 1u);
  this->database().run([](Sql& sql) { sql << "DROP TABLE migrations"; });
  EXPECT_EQ(missing_migrations(this->url()), migrations().size());
  this->database().run([](Sql& sql) {
    sql << "CREATE TABLE migrations (number BIGINT PRIMARY KEY, name TEXT NOT NULL)";
    sql << "INSERT INTO migrations (number, name) VALUES (9999, 'later')";
  });
  test::expect_error(ErrorKind::conflict, "9999", [&] { missing_migrations(this->url()); });
}

TEST(Migrations, AFileThatIsNotThereIsNotMade) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(missing_migrations("sqlite:" + (folder.path() / "ream.db").string()), migrations().size());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "ream.db"));
}

TYPED_TEST(MigrationsTest, RunAStepThatCameLater) {
  this->database().run([](Sql& sql) {
    sql << "DROP TABLE session_records";
    sql << "DROP TABLE sessions";
    sql << "DELETE FROM migrations WHERE number = 1";
  });
  EXPECT_TRUE(SessionIndex(*this->open_again()).marks().empty());
}

TYPED_TEST(MigrationsTest, LeaveNothingOfAStepThatFails) {
  this->database().run([](Sql& sql) {
    sql << "DROP TABLE session_records";
    sql << "DROP TABLE sessions";
    sql << "DELETE FROM migrations WHERE number = 1";
    sql << "CREATE TABLE session_records (id BIGINT)";  // in the way of the step's second statement
  });
  EXPECT_THROW(this->open_again(), Error);
  this->database().run([](Sql& sql) { sql << "DROP TABLE session_records"; });
  EXPECT_TRUE(SessionIndex(*this->open_again()).marks().empty());
}

TYPED_TEST(MigrationsTest, RefuseADatabaseOfANewerBuild) {
  this->database().run(
      [](Sql& sql) { sql << "INSERT INTO migrations (number, name) VALUES (9999, 'later')"; });
  test::expect_error(ErrorKind::conflict, "9999", [&] { this->open_again(); });
}

TEST(Migrations, HaveNumbersOfTheirOwn) {
  ASSERT_FALSE(migrations().empty());
  for (size_t i = 1; i < migrations().size(); ++i)
    EXPECT_LT(migrations()[i - 1].number, migrations()[i].number) << migrations()[i].name;
  for (const Migration& step : migrations()) {
    EXPECT_GT(step.number, 0);
    EXPECT_TRUE(step.statements.ends_with(";\n")) << step.name;
  }
}

}  // namespace
}  // namespace ream::store
