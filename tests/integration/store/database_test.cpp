#include "store/database.hpp"

#include <sys/stat.h>

#include <thread>

#include "store/dialect.hpp"
#include "store/sql.hpp"
#include "support/expect_error.hpp"
#include "support/test_databases.hpp"

namespace ream::store {
namespace {

template <typename Store>
class DatabaseTest : public test::TestDatabase<Store> {
 protected:
  void SetUp() override {
    this->database().run([](Sql& sql) {
      sql << "CREATE TABLE pots (id BIGINT PRIMARY KEY, coins BIGINT NOT NULL)";
      sql << "CREATE TABLE spoons (pot BIGINT NOT NULL REFERENCES pots (id))";
    });
  }
  void put(int id, int coins) {
    this->database().run(
        [&](Sql& sql) { sql << "INSERT INTO pots (id, coins) VALUES (:id, :coins)", use(id), use(coins); });
  }
  std::optional<int> coins_in(int id) {
    return this->database().read([&](Sql& sql) {
      int coins = 0;
      sql << "SELECT coins FROM pots WHERE id = :id", use(id), into(coins);
      return sql.got_data() ? std::optional(coins) : std::nullopt;
    });
  }
};
TYPED_TEST_SUITE(DatabaseTest, test::BothStores, test::StoreNames);

TYPED_TEST(DatabaseTest, KeepsWhatWasPut) {
  this->put(1, 10);
  EXPECT_EQ(this->coins_in(1), 10);
  EXPECT_EQ(this->coins_in(2), std::nullopt);
}

TYPED_TEST(DatabaseTest, UndoesAllOfATransactionThatThrows) {
  this->put(1, 10);
  EXPECT_THROW(this->database().run([](Sql& sql) {
    sql << "UPDATE pots SET coins = 0";
    throw std::runtime_error("no");
  }),
               std::runtime_error);
  EXPECT_EQ(this->coins_in(1), 10);
}

TYPED_TEST(DatabaseTest, SaysThatAKeyIsTaken) {
  this->put(1, 10);
  test::expect_error(ErrorKind::conflict, "pots", [&] { this->put(1, 11); });
  EXPECT_EQ(this->coins_in(1), 10);
}

TYPED_TEST(DatabaseTest, HoldsToForeignKeys) {
  test::expect_error(ErrorKind::conflict, "", [&] {
    this->database().run([](Sql& sql) { sql << "INSERT INTO spoons (pot) VALUES (7)"; });
  });
}

TYPED_TEST(DatabaseTest, NamesNoValuesInErrors) {
  const std::string secret = "very-secret";
  try {
    this->database().run([&](Sql& sql) { sql << "INSERT INTO nothing (id) VALUES (:id)", use(secret); });
    FAIL();
  } catch (const Error& error) {
    const std::string words = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_EQ(words.find(secret), std::string::npos) << words;
    EXPECT_NE(words.find(this->database().name()), std::string::npos) << words;
  }
}

TYPED_TEST(DatabaseTest, SortsTextByBytes) {
  const std::vector<std::string> sorted{"", "-", "A", "B", "a", "b", "\xc3\xa4"};
  const auto found = this->database().run([&](Sql& sql) {
    sql << in_dialect(sql, "CREATE TABLE words (word TEXT PRIMARY KEY)");
    for (auto word = sorted.rbegin(); word != sorted.rend(); ++word)
      sql << "INSERT INTO words (word) VALUES (:word)", use(*word);
    const soci::rowset<std::string> rows = (sql.prepare << "SELECT word FROM words ORDER BY word");
    return std::vector<std::string>(rows.begin(), rows.end());
  });
  EXPECT_EQ(found, sorted);
}

TYPED_TEST(DatabaseTest, TransactionsOfManyThreadsActOneAfterAnother) {
  this->put(1, 0);
  this->put(2, 0);
  constexpr int threads = 4, rounds = 25;
  std::vector<std::thread> all;
  for (int thread = 0; thread < threads; ++thread)
    all.emplace_back([this, thread] {
      for (int round = 0; round < rounds; ++round)
        this->database().run([&](Sql& sql) {
          // Reads both and writes one: without an order of transactions, some of this is lost.
          int sum = 0;
          sql << "SELECT sum(coins) FROM pots", into(sum);
          const int next = sum + 1, id = 1 + thread % 2;
          sql << "UPDATE pots SET coins = coins + (:next - (SELECT sum(coins) FROM pots)) WHERE id = :id",
              use(next), use(id);
        });
    });
  for (std::thread& thread : all) thread.join();
  EXPECT_EQ(*this->coins_in(1) + *this->coins_in(2), threads * rounds);
}

TYPED_TEST(DatabaseTest, AReaderSeesOneState) {
  this->put(1, 10);
  this->database().read([&](Sql& sql) {
    int before = 0, after = 0;
    sql << "SELECT coins FROM pots WHERE id = 1", into(before);
    std::thread([this] {
      this->database().run([](Sql& other) { other << "UPDATE pots SET coins = 11"; });
    }).join();
    sql << "SELECT coins FROM pots WHERE id = 1", into(after);
    EXPECT_EQ(before, after);
  });
  EXPECT_EQ(this->coins_in(1), 11);
}

TYPED_TEST(DatabaseTest, SaysThatItIsBusyWhenNoConnectionGetsFree) {
  DatabaseLimits limits;
  limits.connections = 1;
  limits.timeout = std::chrono::milliseconds(20);
  Database narrow(this->url(), limits);
  narrow.read([&](Sql&) {
    std::thread([&] {
      test::expect_error(ErrorKind::unavailable, narrow.name() + " is busy",
                         [&] { narrow.read([](Sql&) {}); });
    }).join();
  });
  EXPECT_NO_THROW(narrow.read([](Sql&) {}));
}

TYPED_TEST(DatabaseTest, RefusesATransactionInsideAnother) {
  EXPECT_THROW(this->database().run([this](Sql&) { this->coins_in(1); }), std::logic_error);
}

TEST(SqliteDatabase, IsPrivateAndWritesAhead) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("of mine/a=b ream.db", "");
  ::chmod(file.c_str(), 0644);
  Database database("sqlite:" + file.string());
  for (const char* end : {"", "-wal", "-shm"}) {
    struct stat about {};
    ASSERT_EQ(::stat((file.string() + end).c_str(), &about), 0) << end;
    EXPECT_EQ(about.st_mode & 0777, 0600) << end;
  }
}

TEST(SqliteDatabase, WaitsForTheOneWriterOnlySoLong) {
  const test::OnSqlite store;
  Database first(store.url);
  DatabaseLimits limits;
  limits.timeout = std::chrono::milliseconds(20);
  Database second(store.url, limits);
  first.run([&](Sql&) {
    std::thread([&] {
      test::expect_error(ErrorKind::unavailable, second.name() + " is busy",
                         [&] { second.run([](Sql&) {}); });
      EXPECT_NO_THROW(second.read([](Sql&) {}));
    }).join();
  });
  EXPECT_NO_THROW(second.run([](Sql&) {}));
}

TEST(SqliteDatabase, SaysThatAFileIsDamaged) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("ream.db", std::string(5000, 'x'));
  test::expect_error(ErrorKind::io, file.string() + " is damaged",
                     [&] { Database("sqlite:" + file.string()); });
}

TEST(SqliteDatabase, SaysThatAFolderIsMissing) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "missing" / "ream.db";
  test::expect_error(ErrorKind::io, file.string(), [&] { Database("sqlite:" + file.string()); });
}

TEST(PostgresqlDatabase, IsUnavailableUntilItAnswers) {
  test::PostgresServer server;
  const std::string url = server.make_database();
  DatabaseLimits limits;
  limits.pause = std::chrono::milliseconds(0);
  Database database(url, limits);
  const auto one = [&] {
    return database.read([](Sql& sql) {
      int answer = 0;
      sql << "SELECT 1", into(answer);
      return answer;
    });
  };
  EXPECT_EQ(one(), 1);
  server.stop();
  for (int attempt = 0; attempt < 2; ++attempt) {
    test::expect_error(ErrorKind::unavailable, database.name() + " does not answer (Connection refused)",
                       one);
    test::expect_error(ErrorKind::unavailable, "does not answer", [&] { Database other(url); });
  }
  server.start();
  EXPECT_EQ(one(), 1);
}

TEST(PostgresqlDatabase, GoesOnWhenConnectionsWereLostInBetween) {
  test::PostgresServer server;
  Database database(server.make_database());
  server.stop();
  server.start();
  EXPECT_EQ(database.run([](Sql& sql) {
    int answer = 0;
    sql << "SELECT 1", into(answer);
    return answer;
  }),
            1);
}

/// Of a query that answers what it is asked.
int one(Database& database) {
  return database.read([](Sql& sql) {
    int answer = 0;
    sql << "SELECT 1", into(answer);
    return answer;
  });
}

TEST(PostgresqlDatabase, DoesNotWaitForAServerThatHangs) {
  test::PostgresServer server;
  const std::string url = server.make_database();
  DatabaseLimits limits;
  limits.transaction = std::chrono::milliseconds(200);
  limits.pause = std::chrono::milliseconds(1);
  Database database(url + "?connect_timeout=2", limits);
  EXPECT_EQ(one(database), 1);
  server.hang();
  // What hangs first is the connection that is open, then each new one.
  for (int attempt = 0; attempt < 3; ++attempt)
    test::expect_error(ErrorKind::unavailable, database.name() + " does not answer", [&] { one(database); });
  server.go_on();
  for (int answer = 0; answer != 1;) try {
      answer = one(database);
    } catch (const Error& unreachable) {
      ASSERT_EQ(unreachable.kind(), ErrorKind::unavailable) << unreachable.what();
    }
}

TEST(PostgresqlDatabase, AtLengthATransactionMayTakeLongerThanTheLimits) {
  test::PostgresServer& server = test::PostgresServer::shared();
  DatabaseLimits limits;
  limits.transaction = limits.statement = std::chrono::milliseconds(100);
  Database database(server.make_database(), limits);
  const auto sleep = [](Sql& sql) {
    int done = 0;
    sql << "SELECT 1 FROM pg_sleep(0.4)", into(done);
    return done;
  };
  EXPECT_EQ(database.run_at_length(sleep), 1);
  EXPECT_EQ(database.read_at_length(sleep), 1);
  test::expect_error(ErrorKind::unavailable, database.name(), [&] { database.run(sleep); });
  EXPECT_EQ(one(database), 1);
}

}  // namespace
}  // namespace ream::store
