// A disk that fails at any byte, is full, or is lost with its process: the file is whole up to there.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <random>
#include <thread>

#include "core/file.hpp"
#include "support/example_log.hpp"
#include "support/expect_error.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::expect_error;

/// Takes a number of bytes, and then of each append only what still fits.
class FullSink final : public LogSink {
 public:
  FullSink(ops::Bytes& disk, size_t room) : disk_(disk), room_(room) {}
  void append(std::span<const std::byte> bytes) override {
    const size_t taken = std::min(bytes.size(), room_ - disk_.size());
    disk_.insert(disk_.end(), bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(taken));
    if (taken < bytes.size()) throw Error(ErrorKind::io, "cannot write recording.ream: the disk is full");
  }
  void sync() override {}

 private:
  ops::Bytes& disk_;
  const size_t room_;
};

class UnsyncedSink final : public LogSink {
 public:
  explicit UnsyncedSink(const std::filesystem::path& path) : file_(create_log_file(path)) {}
  void append(std::span<const std::byte> bytes) override { file_->append(bytes); }
  void sync() override { throw Error(ErrorKind::io, "cannot write recording.ream: Input/output error"); }

 private:
  std::unique_ptr<LogSink> file_;
};

/// Adds chunks of two ticks until it has added `chunks` or writing fails; tells after each how many there
/// are.
void write_small_chunks(OpLogWriter& log, uint32_t chunks, const std::function<void(uint32_t)>& closed = {}) {
  log.add(test::example_op<ops::Header>(3));
  for (uint32_t i = 0; i < chunks; ++i) {
    test::add_example_chunk(log, 2 * i, 2, i % 3 == 0);
    log.close_chunk();
    if (closed) closed(i + 1);
  }
}

/// Runs `work` in a process of its own and returns its number.
pid_t in_a_child(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  return child;
}

class LogFailure : public testing::Test {
 protected:
  /// The log holds `chunks` chunks of write_small_chunks(), and can be gone on with.
  void expect_chunks_and_go_on(size_t chunks) {
    OpLogReader log(path_);
    log.check_all();
    ASSERT_EQ(log.chunks().size(), chunks) << log.damage();
    const auto ticks = test::all_of<ops::Tick>(log);
    ASSERT_EQ(ticks.size(), 2 * chunks);
    for (uint32_t i = 0; i < ticks.size(); ++i) ASSERT_EQ(ticks[i], test::example_tick(i));
    {
      OpLogWriter more(continue_log_file(path_, log.whole_bytes()), log.chain());
      test::add_example_chunk(more, static_cast<uint32_t>(2 * chunks), 2, false);
      more.close_chunk();
    }
    OpLogReader longer(path_);
    longer.check_all();
    EXPECT_EQ(longer.damage(), "");
    EXPECT_EQ(test::all_of<ops::Tick>(longer).size(), 2 * chunks + 2);
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "recording.ream";
};

TEST_F(LogFailure, ADiskThatIsFullAtAnyByteLeavesEveryWholeChunk) {
  ops::Bytes whole;
  std::vector<size_t> ends;
  {
    OpLogWriter log(std::make_unique<FullSink>(whole, 1 << 20));
    write_small_chunks(log, 3, [&](uint32_t) { ends.push_back(whole.size()); });
  }
  for (size_t room = 0; room < whole.size(); ++room) {
    SCOPED_TRACE("room for " + std::to_string(room) + " of " + std::to_string(whole.size()) + " bytes");
    ops::Bytes disk;
    OpLogWriter log(std::make_unique<FullSink>(disk, room));
    expect_error(ErrorKind::io, "full", [&] { write_small_chunks(log, 3); });
    expect_error(ErrorKind::io, "failed before", [&] { log.close_chunk(); });
    ASSERT_EQ(disk.size(), room) << "nothing may follow what did not fit";
    std::filesystem::remove(path_);
    folder_.write("recording.ream", {reinterpret_cast<const char*>(disk.data()), disk.size()});
    size_t chunks = 0;
    while (ends[chunks] <= room) ++chunks;
    if (chunks == 0)
      expect_error(ErrorKind::invalid_input, "recording.ream", [&] { OpLogReader{path_}; });
    else
      expect_chunks_and_go_on(chunks);
    if (HasFailure()) return;
  }
}

TEST_F(LogFailure, AFailedSyncIsToldAndTheFileStaysWhole) {
  OpLogWriter log(std::make_unique<UnsyncedSink>(path_));
  write_small_chunks(log, 2);
  expect_error(ErrorKind::io, "Input/output", [&] { log.sync(); });
  EXPECT_EQ(OpLogReader(path_).chunks().size(), 2u);
}

TEST_F(LogFailure, ALimitOfTheSystemCutsAWriteShortAndIsNamed) {
  constexpr int told = 42;
  for (const rlim_t limit : {rlim_t{1}, rlim_t{1000}, rlim_t{2345}, rlim_t{3500}}) {
    SCOPED_TRACE(limit);
    std::filesystem::remove(path_);
    const pid_t child = in_a_child([&] {
      const rlimit most{limit, limit};
      if (::setrlimit(RLIMIT_FSIZE, &most) != 0 || ::signal(SIGXFSZ, SIG_IGN) == SIG_ERR) return 1;
      try {
        OpLogWriter log(create_log_file(path_));
        write_small_chunks(log, 1000);
      } catch (const Error& error) {
        const std::string words = error.what();
        return words == "cannot write " + path_.string() + ": File too large" ? told : 2;
      }
      return 3;
    });
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), told);
    EXPECT_EQ(std::filesystem::file_size(path_), limit) << "what fitted of the last write was written";
    if (limit == 1) {
      expect_error(ErrorKind::invalid_input, "recording.ream", [&] { OpLogReader{path_}; });
      continue;
    }
    const size_t chunks = OpLogReader(path_).chunks().size();
    EXPECT_GE(chunks, 1u);
    expect_chunks_and_go_on(chunks);
  }
}

TEST_F(LogFailure, ADeviceThatIsAlwaysFullIsNamed) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  OpLogWriter log(continue_log_file("/dev/full", 0));
  expect_error(ErrorKind::io, "cannot write /dev/full: No space left on device",
               [&] { write_small_chunks(log, 1); });
  expect_error(ErrorKind::io, "/dev/full", [&] { log.sync(); });
}

TEST_F(LogFailure, PlacesThatCannotBeWrittenAreNamed) {
  const auto file = folder_.write("file", "");
  expect_error(ErrorKind::io, "recording.ream", [&] { create_log_file(file / "recording.ream"); });
  expect_error(ErrorKind::io, "recording.ream", [&] { continue_log_file(path_, 0); });
  folder_.write("recording.ream", "short");
  expect_error(ErrorKind::io, "shorter", [&] { continue_log_file(path_, 6); });
  EXPECT_EQ(read_text_file(path_), "short");
}

TEST_F(LogFailure, AProcessKilledAtAnyMomentLosesOnlyTheChunkBeingMade) {
  std::mt19937 random(test::seed());
  void* shared = ::mmap(nullptr, sizeof(std::atomic<uint32_t>), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  auto* closed = new (shared) std::atomic<uint32_t>(0);
  int unfinished = 0, empty = 0;
  for (int round = 0; round < 100 && !HasFailure(); ++round) {
    std::filesystem::remove(path_);
    closed->store(0);
    const pid_t child = in_a_child([&] {
      OpLogWriter log(create_log_file(path_));
      write_small_chunks(log, 1000000, [&](uint32_t chunks) { closed->store(chunks); });
      return 0;
    });
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 8000));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    const uint32_t told = closed->load();
    if (told == 0 && (!std::filesystem::exists(path_) || std::filesystem::file_size(path_) == 0)) {
      ++empty;
      continue;
    }
    const OpLogReader log(path_);
    ASSERT_GE(log.chunks().size(), told);
    ASSERT_LE(log.chunks().size(), told + 1);
    if (!log.damage().empty()) ++unfinished;
    expect_chunks_and_go_on(log.chunks().size());
  }
  RecordProperty("before the first chunk", empty);
  RecordProperty("inside a write", unfinished);
  EXPECT_LT(empty, 90);
  ::munmap(shared, sizeof(std::atomic<uint32_t>));
}

}  // namespace
}  // namespace ream::record
