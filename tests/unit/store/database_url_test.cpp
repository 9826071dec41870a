#include "store/database_url.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"

namespace ream::store {
namespace {

TEST(DatabaseUrl, NamesAFile) {
  const DatabaseUrl url = parse_database_url("sqlite:/data/of mine/a=b.db");
  EXPECT_FALSE(url.postgresql);
  EXPECT_EQ(url.file, "/data/of mine/a=b.db");
  EXPECT_EQ(url.shown, "sqlite:/data/of mine/a=b.db");
}

TEST(DatabaseUrl, ShowsNeitherUserNorPassword) {
  for (const char* text : {"postgresql://me:secret@host:5433/ream", "postgresql://me:sec@ret@host:5433/ream",
                           "postgres://me:secret@host:5433/ream?sslmode=require",
                           "postgresql://host:5433/ream?password=secret"}) {
    const DatabaseUrl url = parse_database_url(text);
    EXPECT_EQ(url.shown, "postgresql://host:5433/ream") << text;
    EXPECT_TRUE(url.has_password) << text;
  }
  EXPECT_FALSE(parse_database_url("postgresql://me@host:5433/ream").has_password);
}

TEST(DatabaseUrl, KeepsWhatItSaysAboutTheConnection) {
  const DatabaseUrl plain = parse_database_url("postgresql://me@host/ream");
  EXPECT_EQ(plain.connect.find("postgresql://me@host/ream?connect_timeout=3&"), 0u) << plain.connect;
  const DatabaseUrl own = parse_database_url("postgresql://me@host/ream?connect_timeout=9");
  EXPECT_EQ(own.connect.find("postgresql://me@host/ream?connect_timeout=9&keepalives"), 0u) << own.connect;
  EXPECT_EQ(own.connect.find("connect_timeout=3"), std::string::npos);
}

TEST(DatabaseUrl, RefusesWhatIsNone) {
  for (const char* text :
       {"", "ream.db", "sqlite:", "sqlite::memory:", "sqlite:a\"b", "mysql://me:secret@host"})
    test::expect_error(ErrorKind::usage, "sqlite:FILE", [&] { parse_database_url(text); });
}

TEST(DatabaseUrl, DoesNotRepeatAPasswordInARefusal) {
  try {
    parse_database_url("mysql://me:secret@host");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("secret"), std::string::npos);
  }
}

}  // namespace
}  // namespace ream::store
