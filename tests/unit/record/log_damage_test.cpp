// Whatever happens to a file: noticed, said in one sentence, and all that was recorded before it is used.
#include <gtest/gtest.h>

#include <random>

#include "core/file.hpp"
#include "support/example_log.hpp"
#include "support/expect_error.hpp"
#include "support/recording_manifest.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"

namespace ream::record {
namespace {

using test::expect_error;
using Bytes = ops::Bytes;

/// A whole log, where its chunks end and what they hold.
struct Known {
  explicit Known(const std::filesystem::path& path) : bytes(read_binary_file(path)) {
    const OpLogReader log(path);
    for (size_t i = 0; i < log.chunks().size(); ++i) {
      begins.push_back(log.chunks()[i].offset);
      contents.push_back(log.read_chunk(i));
    }
    begins.push_back(bytes.size());
    begins.front() = 0;  // the file's header belongs to its first chunk
  }
  Bytes chunk(size_t i) const {
    return {bytes.begin() + static_cast<ptrdiff_t>(begins[i]),
            bytes.begin() + static_cast<ptrdiff_t>(begins[i + 1])};
  }
  /// How many chunks end at or before `size`.
  size_t whole_before(size_t size) const {
    size_t whole = 0;
    while (whole < contents.size() && begins[whole + 1] <= size) ++whole;
    return whole;
  }

  Bytes bytes;
  std::vector<size_t> begins;  ///< of chunk i; the last is the file's end
  std::vector<Bytes> contents;
};

class LogDamage : public testing::Test {
 protected:
  Known example() {
    const auto path = folder_.path() / "example.ream";
    std::filesystem::remove(path);
    test::write_example_log(create_log_file(path));
    return Known(path);
  }

  std::filesystem::path write(const Bytes& bytes) {
    // A new file each time: rewriting one makes some file systems wait for the disk.
    std::filesystem::remove(folder_.path() / "damaged.ream");
    return folder_.write("damaged.ream", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  /// Exactly the first `whole` chunks of `known` are used, and a sentence says why no more are.
  void expect_first(size_t whole, const Known& known, const Bytes& damaged) {
    const auto path = write(damaged);
    if (whole == 0) return expect_error(ErrorKind::invalid_input, "damaged.ream", [&] { OpLogReader{path}; });
    OpLogReader log(path);
    log.check_all();
    ASSERT_EQ(log.chunks().size(), whole);
    EXPECT_EQ(log.whole_bytes(), known.begins[whole]);
    for (size_t i = 0; i < whole; ++i) EXPECT_EQ(log.read_chunk(i), known.contents[i]);
    EXPECT_NE(log.damage().find("damaged.ream"), std::string::npos) << log.damage();
    EXPECT_EQ(log.damage().find('\n'), std::string::npos) << log.damage();
  }

  void truncate_everywhere(const Known& known, size_t step) {
    for (size_t size = 0; size < known.bytes.size(); size += step) {
      SCOPED_TRACE("cut to " + std::to_string(size));
      const size_t whole = known.whole_before(size);
      const Bytes cut(known.bytes.begin(), known.bytes.begin() + static_cast<ptrdiff_t>(size));
      if (whole > 0 && size == known.begins[whole])
        EXPECT_EQ(OpLogReader(write(cut)).damage(), "") << "a cut between chunks leaves a whole recording";
      else
        expect_first(whole, known, cut);
      if (HasFailure()) return;
    }
  }

  void flip_everywhere(const Known& known, size_t step) {
    for (size_t at = 0; at < known.bytes.size(); at += step)
      for (const int flip : {1, 0x80, 0xff}) {
        SCOPED_TRACE("byte " + std::to_string(at) + " xor " + std::to_string(flip));
        Bytes damaged = known.bytes;
        damaged[at] ^= static_cast<std::byte>(flip);
        expect_first(known.whole_before(at), known, damaged);
        if (HasFailure()) return;
      }
  }

  test::TemporaryFolder folder_;
};

TEST_F(LogDamage, TruncatedAtAnyByteItKeepsEveryWholeChunk) { truncate_everywhere(example(), 1); }

TEST_F(LogDamage, AnySingleByteFlippedIsNoticed) { flip_everywhere(example(), 1); }

TEST_F(LogDamage, TheSameHoldsForTheOldestRevision) {
  const Known known(test::golden_recording(2));
  truncate_everywhere(known, 53);
  flip_everywhere(known, 101);
}

TEST_F(LogDamage, WithoutCheckingAllADamagedChunkIsRefusedWhenItIsRead) {
  const Known known = example();
  Bytes damaged = known.bytes;
  damaged[known.begins[2] - 1] ^= std::byte{4};
  const OpLogReader log(write(damaged));
  ASSERT_EQ(log.chunks().size(), known.contents.size());
  EXPECT_EQ(log.read_chunk(0), known.contents[0]);
  expect_error(ErrorKind::invalid_input, "0.050 s into the session", [&] { log.read_chunk(1); });
  EXPECT_EQ(log.read_chunk(2), known.contents[2]);
}

TEST_F(LogDamage, WhatIsAppendedIsNotTakenForARecording) {
  const Known known = example();
  std::mt19937 random(test::seed());
  for (size_t count = 1; count < 200; ++count)
    for (const bool zeros : {false, true}) {
      Bytes longer = known.bytes;
      for (size_t i = 0; i < count; ++i)
        longer.push_back(zeros ? std::byte{0} : static_cast<std::byte>(random()));
      expect_first(known.contents.size(), known, longer);
    }
}

TEST_F(LogDamage, ChunksOutOfPlaceAreNoticed) {
  const Known known = example();
  const auto joined = [&](std::initializer_list<size_t> chunks) {
    Bytes bytes;
    for (const size_t i : chunks) {
      const Bytes chunk = known.chunk(i);
      bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    }
    return bytes;
  };
  expect_first(1, known, joined({0, 2, 3}));
  expect_first(1, known, joined({0, 2, 1, 3}));
  expect_first(2, known, joined({0, 1, 1, 2, 3}));
  expect_first(4, known, joined({0, 1, 2, 3, 3}));
  expect_first(0, known, joined({1, 2, 3}));
}

TEST_F(LogDamage, ChunksOfAnotherRecordingAreNoticed) {
  const Known known = example();
  const auto path = folder_.path() / "other.ream";
  {
    OpLogWriter log(create_log_file(path));
    log.add(test::example_op<ops::Header>(8));
    test::add_example_chunk(log, 0, 50, true);
    log.close_chunk();
    test::add_example_chunk(log, 50, 50, false);
    log.close_chunk();
  }
  const Known other(path);
  Bytes mixed = known.chunk(0);
  const Bytes foreign = other.chunk(1);
  mixed.insert(mixed.end(), foreign.begin(), foreign.end());
  expect_first(1, known, mixed);
}

TEST_F(LogDamage, OfANewerRevisionItAsksForANewerProgram) {
  Bytes newer = example().bytes;
  newer[8] = static_cast<std::byte>(ops::newest_revision + 1);
  // As a newer program would write it: with the checksum of its own first bytes.
  const uint64_t checksum = hash_bytes(std::span(newer).first(12));
  for (size_t k = 0; k < 8; ++k) newer[12 + k] = static_cast<std::byte>(checksum >> (8 * k));
  expect_error(ErrorKind::invalid_input, "newer", [&] { OpLogReader(write(newer)); });
}

}  // namespace
}  // namespace ream::record
