#include "tables/hdf5_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <future>

#include "core/file.hpp"
#include "core/signal_handlers.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

// tests/python/export_test.py reads such files by h5py.
namespace ream::tables {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t all_rows = 1000, chunk_rows = 300;

/// A data set whose last chunk is not full, and one of each other thing.
void fill(Hdf5File& file, double factor) {
  file.add_group("/a/b");
  file.set("/", "words", std::string(100'000, 'x'));
  file.set("/a/b", "count", uint64_t{7});
  file.set("/a/b", "matrix", Hdf5Array{{1.0, 2.0, 3.0, 4.0}, {2, 2}});
  file.add_number("/a/number", factor);
  const size_t numbers = file.add("/a/b/numbers", {Hdf5Type::f64, {all_rows}, {chunk_rows}});
  const size_t bytes = file.add("/bytes", {Hdf5Type::u8, {2, 3}, {2, 2}});
  file.add("/nothing", {Hdf5Type::i64, {0}, {1}});
  std::vector<double> values(chunk_rows);
  for (uint64_t at = 0; at < all_rows; at += chunk_rows) {
    const uint64_t size = std::min(chunk_rows, all_rows - at);
    for (uint64_t i = 0; i < size; ++i) values[i] = factor * static_cast<double>(at + i);
    file.write(numbers, {&at, 1}, {&size, 1}, std::as_bytes(std::span(values).first(size)));
  }
  const std::array<uint8_t, 6> six = {1, 2, 3, 4, 5, 6};
  file.write(bytes, std::array<uint64_t, 2>{0, 0}, std::array<uint64_t, 2>{2, 3},
             std::as_bytes(std::span(six)));
}

std::string written(const fs::path& path, double factor = 1.0) {
  Hdf5File file(path);
  fill(file, factor);
  file.commit();
  return read_text_file(path);
}

TEST(Hdf5File, BeginsWithTheSignatureAndIsAsLongAsItSays) {
  const test::TemporaryFolder folder;
  const std::string file = written(folder.path() / "a.h5");
  EXPECT_TRUE(file.starts_with("\x89HDF\r\n\x1a\n"));
  // Superblock version 0: the end of the file, at byte 40.
  uint64_t end = 0;
  for (size_t i = 0; i < 8; ++i) end |= uint64_t{static_cast<uint8_t>(file[40 + i])} << (8 * i);
  EXPECT_EQ(end, file.size());
}

TEST(Hdf5File, TheSameContentMakesTheSameBytes) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(written(folder.path() / "a.h5") == written(folder.path() / "b.h5"));
}

TEST(Hdf5File, ManyAreWrittenAtOnce) {
  const test::TemporaryFolder folder;
  const std::array<std::string, 2> alone = {written(folder.path() / "0.h5", 1.0),
                                            written(folder.path() / "1.h5", 2.0)};
  std::array<std::string, 4> together;
  {
    std::vector<std::future<void>> threads;
    for (size_t i = 0; i < together.size(); ++i)
      threads.push_back(start_task([&, i] {
        together[i] = written(folder.path() / ("t" + std::to_string(i) + ".h5"), i % 2 == 0 ? 1.0 : 2.0);
      }));
  }
  for (size_t i = 0; i < together.size(); ++i) EXPECT_TRUE(together[i] == alone[i % 2]) << i;
}

TEST(Hdf5File, NothingIsLeftWhenNotCommitted) {
  const test::TemporaryFolder folder;
  {
    Hdf5File file(folder.path() / "a.h5");
    fill(file, 1.0);
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{});
}

TEST(Hdf5File, WhatHdf5RefusesIsToldInItsWords) {
  const test::TemporaryFolder folder;
  Hdf5File file(folder.path() / "a.h5");
  file.add_number("/twice", 1.0);
  test::expect_error(ErrorKind::io, "a.h5: HDF5: name already exists",
                     [&] { file.add_number("/twice", 2.0); });
  file.commit();
}

TEST(Hdf5File, UnwritablePlacesAreNamed) {
  const test::TemporaryFolder folder;
  const fs::path place = folder.path() / "nowhere" / "a.h5";
  test::expect_error(ErrorKind::io, place.string(), [&] { written(place); });
}

}  // namespace
}  // namespace ream::tables
