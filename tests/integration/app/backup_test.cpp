#include "app/backup.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "access/access_control.hpp"
#include "app/data_snapshot.hpp"
#include "app/restore_backup.hpp"
#include "core/data_folder.hpp"
#include "core/file.hpp"
#include "core/file_lock.hpp"
#include "session/folder/session_folder.hpp"
#include "store/session_index.hpp"
#include "store/table_files.hpp"
#include "store/zip_archive.hpp"
#include "support/damage.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/test_databases.hpp"

namespace ream::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::expect_error;

/// Every file below a folder with its contents, but locks.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename() != "lock")
      found[entry.path().lexically_relative(folder)] = read_text_file(entry.path());
  return found;
}

/// A data folder and a database of one kind.
template <typename Store>
struct House {
  House() { fs::create_directories(data()); }
  fs::path data() const { return folder.path() / "data"; }
  void write(const std::string& name, const std::string& text) const { folder.write("data/" + name, text); }
  /// What a backup keeps.
  std::map<std::string, std::string> kept() const {
    std::map<std::string, std::string> found;
    for (const std::string& name : kept_folders(data()))
      for (const auto& [file, text] : contents(data() / name)) found[name + "/" + file] = text;
    return found;
  }
  std::map<std::string, std::string> rows() {
    const test::TemporaryFolder files;
    store::write_table_files(database, files.path());
    return contents(files.path());
  }

  const test::TemporaryFolder folder;
  const Store store;
  store::Database database{store.url};
};

template <typename Store>
void fill(House<Store>& house) {
  for (const char* id : {"aaaa", "bbbb"}) {
    const std::string folder = "sessions/" + std::string(id);
    house.write(folder + "/session.json", json{{"id", id}, {"state", "finished"}}.dump());
    house.write(folder + "/recording.ream", std::string(5000, *id));
    house.write(folder + "/lock", "");
  }
  std::string noise;
  std::mt19937 random(test::seed(7));
  for (int i = 0; i < 200'000; ++i) noise += static_cast<char>(random());
  house.write("cases/demo/case.json", "{}");
  house.write("cases/demo/density.zst", noise);
  house.write("reamers/mine.json", "{\"radius_mm\": 12}");
  house.write("devices/network.json", "{}");
  house.write("uploads/part/ct.zip", "passing");
  house.write("sessions/half.123.tmp/session.json", "{}");
  house.write("sessions/aaaa/session.json.tmp", "half");
  house.write("cases/.import/ct.nrrd", "passing");
  house.write("other.zip", "somebody's");
  store::SessionRow row;
  row.id = "aaaa";
  row.trainee = "J\xc3\xb6rg";
  store::SessionIndex(house.database).put({row});
}

template <typename Store>
class BackupTest : public testing::Test {
 protected:
  fs::path file() const { return place.path() / "backup.zip"; }
  template <typename Other>
  void expect_nothing_restored(House<Other>& house) {
    EXPECT_TRUE(house.kept().empty());
    EXPECT_TRUE(store::filled_tables(house.database).empty());
    for (const auto& entry : fs::directory_iterator(house.data()))
      EXPECT_EQ(entry.path().filename(), "serving.lock");
  }

  const test::TemporaryFolder place;
};
TYPED_TEST_SUITE(BackupTest, test::BothStores, test::StoreNames);

template <typename From, typename To>
void carry(const House<From>&, House<To>& to, const fs::path& file) {
  const RestoreReport report = restore_backup(to.database, to.data(), file, {});
  EXPECT_EQ(report.counts.at("sessions"), 2u);
  EXPECT_EQ(report.aside, "");
}

TYPED_TEST(BackupTest, CarriesEverythingFromOneKindOfDatabaseToTheOtherAndBack) {
  House<TypeParam> first;
  fill(first);
  const BackupReport report = write_backup(first.database, first.data(), this->file());
  EXPECT_EQ(report.counts.at("sessions"), 2u);
  EXPECT_EQ(report.counts.at("cases"), 1u);
  EXPECT_EQ(report.rows, 2u);
  EXPECT_TRUE(report.live.empty());
  EXPECT_EQ(this->place.entries(), std::vector<std::string>{"backup.zip"});

  House<test::OnPostgresql> second;
  carry(first, second, this->file());
  write_backup(second.database, second.data(), this->place.path() / "second.zip");
  House<test::OnSqlite> third;
  carry(second, third, this->place.path() / "second.zip");
  EXPECT_EQ(third.rows(), first.rows());
  auto expected = first.kept();
  std::erase_if(expected, [](const auto& each) {
    return each.first.find(".tmp") != std::string::npos || each.first.find("/.") != std::string::npos;
  });
  EXPECT_EQ(expected.size(), 8u);
  EXPECT_EQ(third.kept(), expected);
  EXPECT_FALSE(fs::exists(third.data() / "other.zip"));
}

TYPED_TEST(BackupTest, IsForItsOwnerOnlyAndKeepsTimes) {
  House<TypeParam> house, other;
  fill(house);
  const fs::path session = house.data() / "sessions/aaaa/session.json";
  const timespec times[2] = {{1'700'000'000, 0}, {1'700'000'000, 0}};
  ::utimensat(AT_FDCWD, session.c_str(), times, 0);
  write_backup(house.database, house.data(), this->file());
  struct stat about {};
  ASSERT_EQ(::stat(this->file().c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777, 0600);
  carry(house, other, this->file());
  ASSERT_EQ(::stat((other.data() / "sessions/aaaa/session.json").c_str(), &about), 0);
  EXPECT_EQ(about.st_mtim.tv_sec, 1'700'000'000);
}

TYPED_TEST(BackupTest, KeepsLiveSessionsAsFarAsTheyHadCome) {
  House<TypeParam> house, other;
  fill(house);
  house.write("sessions/live/session.json", R"({"state": "running"})");
  house.write("sessions/live/recording.ream", std::string(1000, 'a'));
  const auto lock = FileLock::attempt(session::lock_file(house.data() / "sessions/live"));
  ASSERT_TRUE(lock);
  bool grown = false;
  const BackupReport report =
      write_backup(house.database, house.data(), this->file(), [&](double, std::string_view step) {
        if (step != "packing" || grown) return;
        grown = true;
        std::ofstream(house.data() / "sessions/live/recording.ream", std::ios::app) << std::string(5000, 'b');
        write_file_atomically(house.data() / "sessions/live/session.json", std::string_view("{}"));
      });
  EXPECT_TRUE(grown);
  EXPECT_EQ(report.live, std::vector<std::string>{"live"});
  restore_backup(other.database, other.data(), this->file(), {});
  EXPECT_EQ(read_text_file(other.data() / "sessions/live/recording.ream"), std::string(1000, 'a'));
  EXPECT_EQ(read_text_file(other.data() / "sessions/live/session.json"), R"({"state": "running"})");
}

/// What cannot be looked at may be somebody's sessions; a backup without them would be none.
TYPED_TEST(BackupTest, OfWhatCannotBeReadIsNoBackup) {
  House<TypeParam> house;
  fill(house);
  house.write("lost+found/#12", "a file system's own");
  write_backup(house.database, house.data(), this->file());
  EXPECT_EQ(house.kept().count("lost+found/#12"), 0u);
  const fs::path cases = house.data() / "cases", elsewhere = house.folder.path() / "elsewhere";
  fs::rename(cases, elsewhere);
  fs::create_directory_symlink(elsewhere, cases);
  EXPECT_EQ(write_backup(house.database, house.data(), this->file()).counts.at("cases"), 1u);
  // As of a disk that is not mounted.
  fs::rename(elsewhere, house.folder.path() / "unmounted");
  expect_error(ErrorKind::io, cases.string(),
               [&] { write_backup(house.database, house.data(), this->file()); });
  fs::remove(cases);
  fs::create_directory_symlink("nowhere", house.data() / "sessions/gone");
  expect_error(ErrorKind::io, "sessions/gone",
               [&] { write_backup(house.database, house.data(), this->file()); });
}

TYPED_TEST(BackupTest, InterruptedItLeavesNothing) {
  House<TypeParam> house, other;
  fill(house);
  const auto until = [](double most) {
    return [most](double share, std::string_view) {
      if (share >= most) throw Error(ErrorKind::cancelled, "interrupted");
    };
  };
  const auto before = contents(house.folder.path());
  for (const double most : {0.0, 0.05, 0.3, 0.7}) {
    expect_error(ErrorKind::cancelled, "interrupted",
                 [&] { write_backup(house.database, house.data(), this->file(), until(most)); });
    EXPECT_TRUE(this->place.entries().empty());
  }
  EXPECT_EQ(contents(house.folder.path()).size(), before.size());
  write_backup(house.database, house.data(), this->file());
  for (const double most : {0.0, 0.3, 0.75, 0.85, 0.99}) {
    expect_error(ErrorKind::cancelled, "interrupted",
                 [&] { restore_backup(other.database, other.data(), this->file(), {}, until(most)); });
    this->expect_nothing_restored(other);
  }
  carry(house, other, this->file());
}

TYPED_TEST(BackupTest, DamageIsSaidAndNothingIsRestored) {
  std::mt19937 random(test::seed());
  House<TypeParam> house;
  fill(house);
  write_backup(house.database, house.data(), this->file());
  const std::string whole = read_text_file(this->file());
  const auto pick = [&](size_t below) { return std::uniform_int_distribution<size_t>(0, below - 1)(random); };
  int refused = 0;
  for (int round = 0; round < 12; ++round) {
    const fs::path bad = this->place.path() / "bad.zip";
    const bool cut = round % 3 == 0;
    std::ofstream(bad, std::ios::binary) << (cut ? whole.substr(0, pick(whole.size())) : whole);
    if (!cut) test::damage(bad, pick(whole.size() - 2));
    House<TypeParam> other;
    try {
      restore_backup(other.database, other.data(), bad, {});
      EXPECT_EQ(other.rows(), house.rows()) << "bytes that say nothing may change";
      EXPECT_EQ(other.kept().size(), 8u);
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(error.kind(), ErrorKind::invalid_input) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      this->expect_nothing_restored(other);
    }
  }
  EXPECT_GT(refused, 4);
}

TYPED_TEST(BackupTest, WhatIsThereIsMovedAsideOrLeftAlone) {
  House<TypeParam> house, other;
  fill(house);
  write_backup(house.database, house.data(), this->file());
  other.write("sessions/mine/session.json", "{}");
  other.write("scripts/mine.json", "{}");
  store::SessionRow row;
  row.id = "mine";
  store::SessionIndex(other.database).put({row});
  expect_error(ErrorKind::conflict, "--force",
               [&] { restore_backup(other.database, other.data(), this->file(), {}); });
  EXPECT_EQ(other.kept().size(), 2u);
  const RestoreReport report = restore_backup(other.database, other.data(), this->file(), {.force = true});
  EXPECT_TRUE(fs::exists(report.aside / "sessions/mine/session.json"));
  EXPECT_TRUE(fs::exists(report.aside / "scripts/mine.json"));
  EXPECT_NE(read_text_file(report.aside / "tables/sessions.jsonl").find("mine"), std::string::npos);
  EXPECT_EQ(other.rows(), house.rows());
  EXPECT_EQ(other.kept().size(), 8u);
  EXPECT_FALSE(fs::exists(other.data() / "scripts"));

  House<TypeParam> third;
  store::SessionIndex(third.database).put({row});
  expect_error(ErrorKind::conflict, "holds sessions, session_records",
               [&] { restore_backup(third.database, third.data(), this->file(), {}); });
}

TYPED_TEST(BackupTest, AServerThatRunsIsNotTouched) {
  House<TypeParam> house, other;
  fill(house);
  write_backup(house.database, house.data(), this->file());
  const auto serving = FileLock::attempt(serving_lock(other.data()));
  expect_error(ErrorKind::conflict, "a server runs on",
               [&] { restore_backup(other.database, other.data(), this->file(), {.force = true}); });
}

TYPED_TEST(BackupTest, OtherFilesAreRefusedByName) {
  House<TypeParam> other;
  const auto refuse = [&](ErrorKind kind, const std::string& words, const fs::path& file) {
    expect_error(kind, words, [&] { restore_backup(other.database, other.data(), file, {}); });
    this->expect_nothing_restored(other);
  };
  refuse(ErrorKind::not_found, "nowhere.zip", this->place.path() / "nowhere.zip");
  refuse(ErrorKind::invalid_input, "text.zip is not a valid zip archive",
         this->place.write("text.zip", "hello"));
  const auto zip = [&](const std::string& manifest) {
    const fs::path file = this->place.write("backup.json", manifest), made = this->place.path() / "made.zip";
    store::write_zip(made, {{file, manifest.empty() ? "else.json" : "backup.json"}});
    return made;
  };
  refuse(ErrorKind::invalid_input, "is no backup of ream", zip(""));
  refuse(ErrorKind::invalid_input, "made.zip", zip(R"({"format": "else"})"));
  refuse(ErrorKind::invalid_input, "newer version", zip(R"({"format": "ream backup", "revision": 2})"));
  refuse(ErrorKind::invalid_input, "'migrations'", zip(R"({"format": "ream backup", "revision": 1})"));
  refuse(
      ErrorKind::invalid_input, "newer version (ream 9)",
      zip(R"({"format": "ream backup", "revision": 1, "made_utc": "", "build": "ream 9", "files": 0, "tables": [],
                 "migrations": [1, 9999]})"));
  refuse(
      ErrorKind::invalid_input, "0 files of the 3",
      zip(R"({"format": "ream backup", "revision": 1, "made_utc": "", "build": "ream 1", "files": 3, "tables": [],
                 "migrations": []})"));
}

TYPED_TEST(BackupTest, WhatWasRevokedSinceIsNotGoodAgain) {
  House<TypeParam> house;
  fill(house);
  access::AccessControl before(house.database);
  const auto issued = [&](access::CredentialKind kind) {
    return before.credentials.issue(kind, {"u1", {}, "", "", ""}).row.id;
  };
  const std::string token = issued(access::CredentialKind::token),
                    cookie = issued(access::CredentialKind::cookie),
                    link = issued(access::CredentialKind::link);
  write_backup(house.database, house.data(), this->file());
  for (const bool keep : {false, true}) {
    House<TypeParam> other;
    restore_backup(other.database, other.data(), this->file(), {.keep_tokens = keep});
    store::CredentialTable table(other.database);
    EXPECT_EQ(table.find(token).has_value(), keep);
    EXPECT_FALSE(table.find(cookie));
    EXPECT_FALSE(table.find(link));
  }
}

}  // namespace
}  // namespace ream::app
