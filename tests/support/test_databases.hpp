#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "store/database.hpp"
#include "support/postgres_server.hpp"
#include "support/temporary_folder.hpp"

namespace ream::test {

/// The two stores. Each makes a new, empty database for every test.
struct OnSqlite {
  const TemporaryFolder folder;
  const std::string url = "sqlite:" + (folder.path() / "ream.db").string();
};
struct OnPostgresql {
  const std::string url = PostgresServer::shared().make_database();
};

/// Runs each test on both stores:
///
///   template <typename Store>
///   class UserTableTest : public ream::test::TestDatabase<Store> {};
///   TYPED_TEST_SUITE(UserTableTest, ream::test::BothStores, ream::test::StoreNames);
///   TYPED_TEST(UserTableTest, Finds) { UserTable users(this->database()); ... }
template <typename Store>
class TestDatabase : public ::testing::Test {
 protected:
  store::Database& database() { return *database_; }
  const std::string& url() const { return store_.url; }
  /// As another process would: with connections of its own.
  std::unique_ptr<store::Database> open_again() const { return std::make_unique<store::Database>(url()); }

 private:
  const Store store_{};
  const std::unique_ptr<store::Database> database_ = std::make_unique<store::Database>(store_.url);
};

using BothStores = ::testing::Types<OnSqlite, OnPostgresql>;

/// Third argument of TYPED_TEST_SUITE: tests are called by the store's name.
struct StoreNames {
  template <typename Store>
  static std::string GetName(int) {
    return std::is_same_v<Store, OnSqlite> ? "Sqlite" : "Postgresql";
  }
};

}  // namespace ream::test
