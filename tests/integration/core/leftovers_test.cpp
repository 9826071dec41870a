#include "core/leftovers.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "core/atomic_file.hpp"
#include "core/file.hpp"
#include "core/temporary_file.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// A process that makes something in its own folders and then waits for its end.
class Maker {
 public:
  explicit Maker(const std::function<void()>& make) {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    process_ = ::fork();
    if (process_ == 0) {
      make_and_wait(make, ready[1]);
      ::_exit(1);
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Maker() { kill(); }
  Maker(const Maker&) = delete;
  Maker& operator=(const Maker&) = delete;

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  static void make_and_wait(const std::function<void()>& make, int ready) {
    make();
    if (::write(ready, "x", 1) == 1) ::pause();
  }

  pid_t process_ = 0;
};

class LeftoversTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"cases", "sessions", "rubrics", "temporary"}) fs::create_directory(data / name);
    ::setenv("TMPDIR", (data / "temporary").c_str(), 1);
  }
  void TearDown() override { ::unsetenv("TMPDIR"); }

  Names everything() const {
    Names found;
    for (const auto& entry : fs::recursive_directory_iterator(data))
      if (entry.path().parent_path() != data || entry.path().filename().string().front() == '.')
        found.push_back(entry.path().lexically_relative(data).string());
    return found;
  }

  test::TemporaryFolder folder;
  const fs::path data = folder.path();
};

TEST_F(LeftoversTest, OfAKilledProcessAreRemovedAndOfALivingOneNot) {
  fs::create_directory(data / "sessions/abcdefgh");
  Maker maker([&] {
    static AtomicFile file(data / "rubrics/one.json"), session(data / "sessions/abcdefgh/session.json");
    static AtomicFolder made(data / "cases/doe-jane");
    static TemporaryFolder backup(data / ".backup"), read(data / "temporary/ream-read"),
        picture(data / "temporary/ream-picture");
    write_file_atomically(made.path() / "ct.json", "a patient's");
    write_file_atomically(read.path() / "values", "a patient's");
    write_file_atomically(picture.path() / "scene", "a patient's");
    file.write("half");
  });
  EXPECT_GE(everything().size(), 6u);
  EXPECT_EQ(remove_leftovers(data), 0u);
  EXPECT_GE(everything().size(), 6u);
  maker.kill();
  EXPECT_EQ(remove_leftovers(data), 6u);
  EXPECT_EQ(everything(), Names{"sessions/abcdefgh"});
}

TEST_F(LeftoversTest, CasesOnTheirWayOutAreRemoved) {
  folder.write("cases/.doe-jane.deleted/ct.json", "a patient's");
  EXPECT_EQ(remove_leftovers(data), 1u);
  EXPECT_EQ(everything(), Names{});
}

TEST_F(LeftoversTest, NothingElseIsTouched) {
  const Names others{"cases/one.tmp",
                     "cases/shoulder.12.nrrd",
                     "rubrics/a.b.tmp",
                     "sessions/abcdefgh/recording.ream",
                     ".hidden/file",
                     ".not.quite77/file",
                     "temporary/ream-read.txt",
                     "temporary/other.AbCdEf/file"};
  for (const std::string& name : others) folder.write(name, "kept");
  EXPECT_EQ(remove_leftovers(data), 0u);
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(data / name)) << name;
  EXPECT_EQ(remove_leftovers(data / "nowhere"), 0u);
}

TEST_F(LeftoversTest, OnesBesideAFileAreRemovedBesideItOnly) {
  folder.write(".ream-unfinished.AbCdEf/backup.zip", "half");
  folder.write(".ream-unfinished.AbCdE/backup.zip", "somebody's own");
  folder.write("other.zip.AbCdEf/other.zip", "somebody's own");
  folder.write("backup.zip", "whole");
  EXPECT_EQ(remove_leftovers_beside(data / "backup.zip"), 1u);
  EXPECT_FALSE(fs::exists(data / ".ream-unfinished.AbCdEf"));
  EXPECT_TRUE(fs::exists(data / ".ream-unfinished.AbCdE"));
  EXPECT_TRUE(fs::exists(data / "other.zip.AbCdEf"));
  EXPECT_TRUE(fs::exists(data / "backup.zip"));
}

}  // namespace
}  // namespace ream
