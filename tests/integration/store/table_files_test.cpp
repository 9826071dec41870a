#include "store/table_files.hpp"

#include <fstream>
#include <functional>
#include <set>

#include "core/file.hpp"
#include "store/dialect.hpp"
#include "store/migrations.hpp"
#include "store/session_index.hpp"
#include "store/sql.hpp"
#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

namespace fs = std::filesystem;

/// Something in every table, with values that are easily spoiled on the way.
void fill(Database& database) {
  database.run([](Sql& sql) {
    int table_number = 0;
    for (const std::string& table : table_names()) {
      ++table_number;
      for (const char* key : {"a", "b"}) {
        std::string names, values;
        for (const Column& column : columns_of(sql, table)) {
          names += (names.empty() ? "" : ", ") + column.name;
          values += values.empty() ? "" : ", ";
          if (column.kind == Column::Kind::whole)
            values += std::string("9007199254740993 + ") + (*key == 'a' ? "0" : "1");
          else if (column.kind == Column::Kind::number)
            values += "0.1 + 0.2";
          else
            values += "'" + std::string(key) + "'";
        }
        sql << "INSERT INTO " + table + " (" + names + ") VALUES (" + values + ")";
      }
    }
  });
  SessionRow row;
  row.id = "odd";
  row.trainee = "J\xc3\xb6rg \"B\"\t\n\\\x01";
  row.duration_s = 1e-300;
  row.stamp = INT64_MIN;
  SessionIndex(database).put({row});
}

std::string contents(const fs::path& folder) {
  std::string text;
  for (const std::string& table : table_names()) text += read_text_file(folder / (table + ".jsonl"));
  return text;
}

template <typename Store>
class TableFilesTest : public test::TestDatabase<Store> {
 protected:
  /// Into a new database of one kind and back out.
  template <typename Other>
  std::string through(const fs::path& from, const std::vector<TableFile>& files, const fs::path& to) {
    const Other store;
    Database database(store.url);
    read_table_files(database, from, files, [] {});
    fs::create_directories(to);
    write_table_files(database, to);
    return contents(to);
  }
  fs::path folder(const std::string& name) const {
    fs::create_directories(files_.path() / name);
    return files_.path() / name;
  }

 private:
  const test::TemporaryFolder files_;
};
TYPED_TEST_SUITE(TableFilesTest, test::BothStores, test::StoreNames);

TYPED_TEST(TableFilesTest, AreTheSameFromBothStores) {
  fill(this->database());
  const auto files = write_table_files(this->database(), this->folder("first"));
  EXPECT_EQ(files.size(), table_names().size());
  for (const TableFile& file : files) EXPECT_GE(file.rows, 2u) << file.table;
  const std::string first = contents(this->folder("first"));
  EXPECT_EQ(this->template through<test::OnSqlite>(this->folder("first"), files, this->folder("sqlite")),
            first);
  EXPECT_EQ(
      this->template through<test::OnPostgresql>(this->folder("first"), files, this->folder("postgresql")),
      first);
  EXPECT_EQ(this->template through<test::OnSqlite>(this->folder("postgresql"), files, this->folder("again")),
            first);
}

TYPED_TEST(TableFilesTest, ReplaceWhatIsThereAndNumberingGoesOn) {
  const auto note = [this] {
    return this->database().run([](Sql& sql) {
      sql << "INSERT INTO audit (at_utc, user_id, name, role, credential, address, action, object, detail) "
             "VALUES ('', '', '', '', '', '', '', '', '')";
      long long number = 0;
      sql << "SELECT max(number) FROM audit", into(number);
      return number;
    });
  };
  for (int i = 0; i < 5; ++i) note();
  const auto files = write_table_files(this->database(), this->folder("five"));
  for (int i = 0; i < 3; ++i) note();
  SessionRow row;
  row.id = "later";
  SessionIndex(this->database()).put({row});
  EXPECT_EQ(filled_tables(this->database()).size(), 3u);
  read_table_files(this->database(), this->folder("five"), files, [] {});
  EXPECT_EQ(filled_tables(this->database()), std::vector<std::string>{"audit"});
  EXPECT_GE(note(), 6);
  const auto other = this->open_again();
  EXPECT_GE(note(), 7);
}

TYPED_TEST(TableFilesTest, LeaveEverythingWhenSomethingIsWrong) {
  fill(this->database());
  const auto files = write_table_files(this->database(), this->folder("good"));
  const std::string before = contents(this->folder("good"));
  const auto refused = [&](const std::string& named, const std::function<void(std::string&)>& change) {
    const fs::path bad = this->folder("bad");
    for (const TableFile& file : files)
      fs::copy_file(this->folder("good") / (file.table + ".jsonl"), bad / (file.table + ".jsonl"),
                    fs::copy_options::overwrite_existing);
    std::string text = read_text_file(bad / "sessions.jsonl");
    change(text);
    std::ofstream(bad / "sessions.jsonl", std::ios::binary) << text;
    test::expect_error(ErrorKind::invalid_input, named,
                       [&] { read_table_files(this->database(), bad, files, [] {}); });
    write_table_files(this->database(), this->folder("after"));
    EXPECT_EQ(contents(this->folder("after")), before);
  };
  const auto replace = [](const std::string& old_text, const std::string& new_text) {
    return [=](std::string& text) { text.replace(text.find(old_text), old_text.size(), new_text); };
  };
  refused("sessions.jsonl, line 1", replace("\"script\"", "\"scribble\""));
  refused("sessions.jsonl, line 1", replace("[", "{"));
  refused("sessions.jsonl, line 2", replace("\"a\",\"a\"", "\"a\""));
  refused("sessions.jsonl, line 3: column case_id", replace("\"b\",\"b\"", "\"b\",7"));
  refused("sessions.jsonl does not hold the 3 rows",
          [](std::string& text) { text.erase(text.find("[\"odd\"")); });
  EXPECT_THROW(
      read_table_files(this->database(), this->folder("good"), files, [] { throw std::runtime_error("no"); }),
      std::runtime_error);
  write_table_files(this->database(), this->folder("after"));
  EXPECT_EQ(contents(this->folder("after")), before);
}

TEST(TableNames, AreThoseOfTheDatabase) {
  const test::OnSqlite store;
  const auto found = Database(store.url).read([](Sql& sql) {
    std::set<std::string> names;
    const soci::rowset<std::string> rows =
        (sql.prepare << "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite_%'");
    for (const std::string& name : rows) names.insert(name);
    return names;
  });
  const auto named = table_names();
  std::set<std::string> expected(named.begin(), named.end());
  EXPECT_EQ(expected.size(), named.size());
  expected.insert("migrations");
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace ream::store
