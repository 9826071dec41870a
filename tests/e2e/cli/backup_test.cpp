#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <random>
#include <thread>

#include "e2e/cli/serve_block_fixture.hpp"
#include "support/places.hpp"
#include "support/postgres_server.hpp"
#include "support/seed.hpp"

namespace ream::test {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

class Backup : public ServeBlock {
 protected:
  std::string run_session() {
    const std::string id = create();
    request(200, "POST", path_of(id) + "/start");
    until("it has reamed a while", [&] { return duration_s(id) > 2.0; });
    return id;
  }
};

TEST_F(Backup, CarriesARunningServersSessionsIntoPostgresqlAndBack) {
  serve_when_ready();
  const std::string ended = run_session();
  request(200, "POST", "/api/v1/sessions/" + ended + "/stop");
  const std::string live = run_session();
  const json made = answer({"backup", "first.zip"});
  EXPECT_EQ(made.at("live"), json::array({live}));
  EXPECT_EQ(made.at("sessions"), 2);
  EXPECT_GE(made.at("cases").get<int>(), 1);
  EXPECT_EQ(request(200, "GET", "/api/v1/sessions/" + live).at("state"), "running");
  end_server();

  PostgresServer postgres;
  const std::string url = postgres.make_database();
  const json restored = answer({"restore", "first.zip", "--data", "second", "--db", url});
  EXPECT_EQ(restored.at("sessions"), 2);
  EXPECT_EQ(restored.at("database").get<std::string>().find("ream@"), std::string::npos);
  serve_when_ready({"--data", "second", "--db", url});
  EXPECT_EQ(request(200, "GET", "/api/v1/sessions/" + ended).at("state"), "stopped");
  const json kept = request(200, "GET", "/api/v1/sessions/" + live);
  EXPECT_EQ(kept.at("state"), "interrupted");
  EXPECT_GT(kept.at("duration_s").get<double>(), 1.0);
  EXPECT_EQ(request(200, "GET", "/api/v1/sessions").at("sessions").size(), 2u);
  refuse(1, "a server runs on", {"restore", "first.zip", "--force", "--data", "second", "--db", url});
  end_server();
  for (const std::string& id : {ended, live}) succeed({"replay", id, "--verify", "--data", "second"});

  succeed({"backup", "second.zip", "--data", "second", "--db", url});
  EXPECT_EQ(answer({"restore", "second.zip", "--data", "third"}).at("rows"), 6);
  const std::string log = succeed({"audit", "export", "--data", "third"}).out;
  EXPECT_NE(log.find("first.zip; the log before it ended with row 0"), std::string::npos) << log;
  EXPECT_NE(log.find("second.zip; the log before it ended with row 0"), std::string::npos) << log;
  EXPECT_NE(succeed({"audit", "export", "--data", "second", "--db", url}).out.find("data.backup"),
            std::string::npos);
  EXPECT_EQ(answer({"list", "sessions", "--data", "third"}),
            answer({"list", "sessions", "--data", "second"}));
}

TEST_F(Backup, WhatCannotBeUsedIsNamed) {
  write("text.zip", "hello");
  succeed({"backup", "good.zip"});
  refuse(1, "nowhere.zip", {"restore", "nowhere.zip", "--data", "other"});
  refuse(1, "text.zip", {"restore", "text.zip", "--data", "other"});
  refuse(1, "--force", {"restore", "good.zip"});
  refuse(1, "cannot write missing/backup.zip: No such file or directory", {"backup", "missing/backup.zip"});
  refuse(1, "cannot write data: it is no file", {"backup", "data"});
  refuse(1, "cannot write text.zip/backup.zip: Not a directory", {"backup", "text.zip/backup.zip"});
  refuse(1, "no data folder", {"backup", "a.zip", "--data", "nowhere"});
  refuse(2, "FILE", {"backup"});
  refuse(2, "sqlite:FILE", {"backup", "a.zip", "--db", "ream.db"});
  refuse(2, "REAM_DB", {"backup", "a.zip", "--db", "postgresql://me:secret@127.0.0.1/ream"});
  refuse(1, "postgresql://127.0.0.1:1/ream does not answer",
         {"backup", "a.zip", "--db", "postgresql://me@127.0.0.1:1/ream"});
}

TEST_F(Backup, AFullDiskLeavesNothing) {
  std::string noise;
  std::mt19937 random(test::seed(1));
  for (int i = 0; i < 100'000; ++i) noise += static_cast<char>(random());
  write("data/reamers/noise.bin", noise);
  succeed({"user", "list"});
  std::filesystem::copy_file(folder() / "data/ream.db", folder() / "empty.db");
  succeed({"backup", "good.zip"});
  const auto before = tree();
  const std::string program = build_folder() + "/ream";
  for (const std::string& command :
       {program + " backup other.zip", program + " restore good.zip --data data2"}) {
    std::filesystem::create_directories(folder() / "data2");
    std::filesystem::copy_file(folder() / "empty.db", folder() / "data2/ream.db",
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(start_program({"/bin/sh", "-c", "ulimit -f 64; exec " + command}, "full")  // 32 KiB a file
                  ->wait(60s),
              1);
    const std::string words = printed("full.err");
    EXPECT_EQ(words.rfind("ream: cannot write", 0), 0u) << words;
    EXPECT_EQ(std::count(words.begin(), words.end(), '\n'), 1) << words;
    std::filesystem::remove_all(folder() / "data2");
    EXPECT_EQ(tree(), before);
  }
}

TEST_F(Backup, ADeviceOrAPipeIsNotReplaced) {
  std::filesystem::create_symlink("/dev/null", folder() / "nothing");
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  for (const std::string name : {"nothing", "pipe"}) {
    refuse(1, "cannot write " + name + ": it is no file", {"backup", name});
    EXPECT_FALSE(std::filesystem::is_regular_file(folder() / name));
  }
}

TEST_F(Backup, TheIndexOfSessionsIsMadeAnew) {
  write("data/sessions/aaaa/session.json", R"({"state": "finished", "case": "block"})");
  const json listed = answer({"list", "sessions", "--rebuild-index"});
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed.at(0).at("id"), "aaaa");
  refuse(2, "only sessions", {"list", "cases", "--rebuild-index"});
}

}  // namespace
}  // namespace ream::test
