#include "isolation/isolated_job.hpp"
#include "isolation/isolated_service.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "core/file.hpp"
#include "isolation/sandbox.hpp"
#include "support/expect_error.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"

namespace ream::isolation {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::expect_error;

/// Runs tasks of tests/integration/isolation/probe.cpp, a reader that a file has taken over.
class IsolatedJobs : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(scratch());
    fs::create_directory(folder_.path() / "in");
    write("in/given.txt", "words of a stranger");
    write("secret.txt", "a secret");
  }
  void TearDown() override { EXPECT_TRUE(fs::is_empty(scratch())) << "something of a reader is left"; }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name) << text;
  }
  fs::path scratch() const { return folder_.path() / "scratch"; }
  fs::path given() const { return folder_.path() / "in/given.txt"; }

  IsolatedJob job(const std::string& task, const json& options = json::object()) const {
    IsolatedJob made;
    made.program = fs::path(test::build_folder()) / "isolation_probe";
    made.task = task;
    made.input = given();
    made.options = options;
    made.scratch = scratch();
    return made;
  }
  json answer(const std::string& task, const json& options = json::object()) const {
    return run_isolated(job(task, options)).answer();
  }
  void expect_refused(const IsolatedJob& wrong, const std::string& words) const {
    expect_error(ErrorKind::invalid_input, words, [&] { run_isolated(wrong); });
    expect_error(ErrorKind::invalid_input, "given.txt", [&] { run_isolated(wrong); });
  }

  test::TemporaryFolder folder_;
};

TEST_F(IsolatedJobs, ReadsWhatItIsGivenAndWritesBesideNothingElse) {
  std::vector<std::string> steps;
  {
    const IsolatedResult result =
        run_isolated(job("read"), [&](double, std::string_view step) { steps.emplace_back(step); });
    EXPECT_EQ(result.answer()["text"], "words of a stranger");
    EXPECT_EQ(read_text_file(result.file("copy")), "words of a stranger");
    expect_error(ErrorKind::io, "missing", [&] { result.file("missing"); });
  }
  ASSERT_FALSE(steps.empty());
  EXPECT_EQ(steps.back(), "half way");
  IsolatedJob folder = job("read");
  folder.input = folder_.path() / "in";
  EXPECT_EQ(run_isolated(folder).answer()["below"], json::array({"given.txt"}));
  IsolatedJob missing = job("read");
  missing.input = folder_.path() / "nowhere";
  expect_error(ErrorKind::not_found, "nowhere", [&] { run_isolated(missing); });
}

TEST_F(IsolatedJobs, CannotReachAnyOtherFile) {
  if (sandbox_support().landlock == 0) GTEST_SKIP() << "this kernel has no Landlock";
  write("in/sibling.txt", "of another patient");
  const std::string secret = (folder_.path() / "secret.txt").string();
  const std::string own_environment = "/proc/" + std::to_string(::getpid()) + "/environ",
                    sibling = (folder_.path() / "in/sibling.txt").string();
  const std::vector<std::string> paths{secret,
                                       "../../secret.txt",
                                       "/etc/passwd",
                                       "/proc/self/environ",
                                       "/proc/self/cmdline",
                                       own_environment,
                                       "/proc/self/root" + secret,
                                       "/proc/self/cwd/../../secret.txt",
                                       sibling,
                                       "/dev/mem",
                                       "/dev/shm/probe"};
  for (const std::string& path : paths) {
    const json told = answer("reach", {{"path", path}});
    for (const char* way : {"read", "write", "create", "remove"})
      EXPECT_NE(told[way], "done") << way << " " << path;
  }
  EXPECT_EQ(read_text_file(secret), "a secret");
  const json own = answer("reach", {{"path", given().string()}});
  EXPECT_EQ(own["read"], "done");
  EXPECT_NE(own["write"], "done");
  EXPECT_NE(own["remove"], "done");
}

TEST_F(IsolatedJobs, ReachesANeighbourThatItIsGivenAndNothingElseOfTheFolder) {
  if (sandbox_support().landlock == 0) GTEST_SKIP() << "this kernel has no Landlock";
  for (const char* name : {"voxels.raw", "key"}) write(std::string("in/") + name, "of the user");
  fs::create_symlink(folder_.path() / "secret.txt", folder_.path() / "in/link.raw");
  const auto told = [&](const std::string& neighbour, const std::string& path) {
    IsolatedJob reach = job("reach", {{"path", path}});
    reach.neighbour = neighbour;
    return run_isolated(reach).answer();
  };
  const std::string folder = (folder_.path() / "in").string();
  for (const std::string& way : {std::string("input/folder/"), folder + "/", std::string("/proc/self/fd/3/")})
    for (const char* name : {"given.txt", "voxels.raw"}) {
      const json of_own = told("voxels.raw", way + name);
      EXPECT_EQ(of_own["read"], "done") << way << name;
      for (const char* change : {"write", "create", "remove", "list"})
        EXPECT_NE(of_own[change], "done") << change << ' ' << way << name;
    }
  for (const char* path : {"key", "link.raw", ".", "../secret.txt"})
    EXPECT_NE(told("voxels.raw", std::string("input/folder/") + path)["read"], "done") << path;
  EXPECT_NE(told("link.raw", "input/folder/link.raw")["read"], "done");
  EXPECT_NE(told("link.raw", (folder_.path() / "secret.txt").string())["read"], "done");
  EXPECT_EQ(told("missing.raw", "input/folder/given.txt")["read"], "done");
  fs::create_directory(folder_.path() / "in/sub");
  write("in/sub/key", "of the user");
  for (const char* path : {"sub", "sub/key"})
    EXPECT_NE(told("sub", std::string("input/folder/") + path)["read"], "done") << path;
}

TEST_F(IsolatedJobs, HasNoNetworkNoProgramsNoSignalsAndNoSecrets) {
  if (!sandbox_support().seccomp) GTEST_SKIP() << "this kernel has no seccomp";
  ::setenv("REAM_PROBE_SECRET", "a secret", 1);
  const json told = answer("call", {{"parent", ::getpid()}});
  for (const char* what : {"tcp", "udp", "unix", "fork", "exec", "signal", "code", "code of a file"})
    EXPECT_EQ(told[what], "Operation not permitted") << what;
  EXPECT_EQ(told["environment"], json::array({"GLIBC_TUNABLES=glibc.malloc.hugetlb=1"}));
  EXPECT_EQ(told["descriptors"], json::array());
  EXPECT_EQ(told["thread"], 7);
}

TEST_F(IsolatedJobs, ChangesNoFileOfTheUserAndNoOtherProcess) {
  if (!sandbox_support().seccomp) GTEST_SKIP() << "this kernel has no seccomp";
  const fs::path secret = folder_.path() / "secret.txt";
  fs::permissions(secret, fs::perms::owner_read | fs::perms::owner_write);
  const auto written = fs::last_write_time(secret);
  const json told = answer("misuse", {{"parent", ::getpid()}, {"path", secret.string()}});
  EXPECT_GT(told.size(), 60u);
  for (const auto& [what, outcome] : told.items()) EXPECT_EQ(outcome, "Operation not permitted") << what;
  EXPECT_EQ(fs::status(secret).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(fs::last_write_time(secret), written);
}

TEST_F(IsolatedJobs, StaysWithinItsLimits) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose shadows need terabytes
  IsolatedJob memory = job("take_memory");
  memory.limits.memory_bytes = uint64_t{512} << 20;
  expect_refused(memory, "does not fit into the memory");
#endif
  IsolatedJob disk = job("take_disk");
  disk.limits.file_bytes = 8 << 20;
  expect_refused(disk, "larger than is taken");
  IsolatedJob full = job("spin");
  full.limits.least_free_bytes = std::numeric_limits<uint64_t>::max();
  expect_error(ErrorKind::io, "nearly full", [&] { run_isolated(full); });
  IsolatedJob processor = job("spin");
  processor.limits.processor_s = 1;
  expect_refused(processor, "more than 1 s of processor time");
}

TEST_F(IsolatedJobs, ItsCrashIsOneSentence) {
#if !defined(__SANITIZE_ADDRESS__)  // which ends the process itself, and in its own way
  expect_refused(job("crash", {{"how", "segfault"}}), "crashed on it (Segmentation fault)");
#endif
  expect_refused(job("crash", {{"how", "abort"}}), "crashed on it (Aborted)");
  expect_refused(job("crash", {{"how", "exit"}}), "without an answer");
  expect_refused(job("crash", {{"how", "throw"}}), "a library gave up");
  expect_refused(job("no_such_task"), "cannot be read");
}

TEST_F(IsolatedJobs, AFailureIsToldInTheWordsOfItsJob) {
  IsolatedJob drawing = job("crash", {{"how", "exit"}});
  drawing.words = {"the renderer", "the picture cannot be drawn", "", ErrorKind::unavailable};
  expect_error(ErrorKind::unavailable, "the picture cannot be drawn: the renderer ended without an answer",
               [&] { run_isolated(drawing); });
}

/// The compiler of a driver writes code and runs it; it gets nothing else for that.
TEST_F(IsolatedJobs, MayRunWhatItHasWrittenWhereItsJobCompiles) {
  if (!sandbox_support().seccomp) GTEST_SKIP() << "this kernel has no seccomp";
  IsolatedJob compiling = job("call", {{"parent", ::getpid()}});
  compiling.limits.compiles = true;
  const json told = run_isolated(compiling).answer();
  EXPECT_EQ(told["code"], "done");
  for (const char* what : {"tcp", "udp", "unix", "fork", "exec", "signal", "code of a file"})
    EXPECT_EQ(told[what], "Operation not permitted") << what;
}

TEST_F(IsolatedJobs, ItsAnswersAreNotTrusted) {
  const auto odd = [&](const std::string& text, size_t times = 1) {
    return job("answer_oddly", {{"text", text}, {"times", times}});
  };
  const std::string deep(10000, '[');
  for (const std::string& text :
       {std::string("no JSON at all\n"), std::string("\n\n"), "{\"answer\":" + deep + "\n",
        "{\"answer\":" + std::string(5000, '[') + std::string(5000, ']') + "}\n",
        std::string("{\"error\": {\"a\": 1}}\n"), std::string("{\"share\": \"x\"}\n")})
    EXPECT_THROW(run_isolated(odd(text)), Error) << text.substr(0, 40);
  EXPECT_THROW(run_isolated(odd(std::string(10000, 'x'), 4000)), Error);
  try {
    run_isolated(odd("{\"error\": \"one\\ntwo\\u001b[31m" + std::string(9000, 'x') + "\", \"kind\": 99}\n"));
    ADD_FAILURE() << "an error was taken for an answer";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::invalid_input);
    EXPECT_LT(std::string(error.what()).size(), 1100u);
    EXPECT_EQ(std::string(error.what()).find_first_of("\n\033"), std::string::npos);
  }
}

TEST_F(IsolatedJobs, EndsWhenItsWorkIsCancelled) {
  int calls = 0;
  EXPECT_THROW(run_isolated(job("sleep"),
                            [&](double, std::string_view) {
                              if (++calls == 3) throw Error(ErrorKind::cancelled, "cancelled");
                            }),
               Error);
}

TEST_F(IsolatedJobs, EndsAfterItsTimeAlsoWhenItSleepsOrOnlyTellsProgress) {
  const auto refused_in_time = [&](IsolatedJob slow) {
    slow.limits.time = std::chrono::milliseconds(300);
    expect_refused(slow, "did not answer within 1 s");
  };
  refused_in_time(job("sleep"));
  refused_in_time(job("tell"));
}

TEST_F(IsolatedJobs, NothingButFilesAndFoldersIsTakenFromIt) {
  for (const std::string odd :
       {"ln -s /etc leads", "mkdir -p a/b && ln -s ../../in a/b/leads", "mkfifo waits"}) {
    write("reader", "#!/bin/sh\ncd /proc/self/fd/" + std::to_string(output_descriptor) + "\n" + odd +
                        "\necho '{\"answer\": {}}' >&" + std::to_string(answer_descriptor) + "\n");
    fs::permissions(folder_.path() / "reader", fs::perms::owner_all);
    IsolatedJob taken_over = job("read");
    taken_over.program = folder_.path() / "reader";
    expect_error(ErrorKind::io, "neither a file nor a folder", [&] { run_isolated(taken_over); });
  }
}

TEST_F(IsolatedJobs, WithoutItsProgramItSaysSo) {
  IsolatedJob lost = job("read");
  lost.program = folder_.path() / "nowhere/ream-reader";
  expect_error(ErrorKind::io, "nowhere/ream-reader: No such file", [&] { run_isolated(lost); });
}

TEST_F(IsolatedJobs, ATwistedNameOfAFileIsNoPath) {
  for (const char* name : {"-rf", "a b\tc", "\xff\xfe", "%s%n", "input", "folder", "..x"}) {
    write(std::string("in/") + name, "words");
    IsolatedJob odd = job("read");
    odd.input = folder_.path() / "in" / name;
    EXPECT_EQ(run_isolated(odd).answer()["text"], "words") << name;
  }
}

}  // namespace
}  // namespace ream::isolation
