#include "tables/parquet_file.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

// web/test/exports reads such files by a program of others.
namespace ream::tables {
namespace {

const std::vector<Column>& columns() {
  static const std::vector<Column> all = {{"t_s", "s", "Time."},
                                          {"points", "", "How many.", ColumnType::count},
                                          {"on", "", "Whether.", ColumnType::flag}};
  return all;
}

ColumnBatch batch_of(int rows) {
  ColumnBatch batch(columns(), static_cast<size_t>(rows));
  for (int i = 0; i < rows; ++i) {
    batch.add(0.25 * i);
    batch.add(int64_t{i} - 2);
    batch.add(int64_t{i % 3 == 0});
  }
  return batch;
}

template <typename Value>
Value value_at(const ColumnBatch& batch, size_t column, size_t row) {
  Value value;
  std::memcpy(&value, batch.values(column).data() + row * sizeof value, sizeof value);
  return value;
}

TEST(ColumnBatch, HoldsEachColumnForItself) {
  ColumnBatch batch = batch_of(5);
  EXPECT_EQ(batch.rows(), 5u);
  EXPECT_TRUE(batch.full());
  EXPECT_EQ(batch.values(0).size(), 5 * sizeof(double));
  EXPECT_EQ(batch.values(2).size(), 5u);
  EXPECT_EQ(value_at<double>(batch, 0, 4), 1.0);
  EXPECT_EQ(value_at<int64_t>(batch, 1, 0), -2);
  EXPECT_EQ(value_at<uint8_t>(batch, 2, 3), 1);
  EXPECT_EQ(value_at<uint8_t>(batch, 2, 4), 0);
  batch.clear();
  EXPECT_EQ(batch.rows(), 0u);
  EXPECT_TRUE(batch.values(1).empty());
}

TEST(ColumnBatch, RefusesAValueOfAnotherTypeAndARowTooMany) {
  ColumnBatch batch(columns(), 1);
  EXPECT_THROW(batch.add(int64_t{1}), std::logic_error);
  batch.add(1.0);
  EXPECT_THROW(batch.add(1.0), std::logic_error);
  batch.add(int64_t{1});
  batch.add(int64_t{1});
  EXPECT_THROW(batch.add(1.0), std::logic_error);
}

std::string written(const std::filesystem::path& path, int groups) {
  ParquetFile file(path, columns(), {{"session", "s1"}}, "ream version 1.2.3");
  for (int i = 0; i < groups; ++i) file.add(batch_of(100));
  file.add(batch_of(0));
  file.finish();
  return read_text_file(path);
}

/// The length of the footer stands before the magic number at the end.
size_t footer_bytes(const std::string& file) {
  size_t bytes = 0;
  for (size_t i = 0; i < 4; ++i) bytes |= size_t{static_cast<uint8_t>(file[file.size() - 8 + i])} << (8 * i);
  return bytes;
}

TEST(ParquetFile, IsFramedAsTheFormatWantsIt) {
  const test::TemporaryFolder folder;
  for (const int groups : {0, 1, 3}) {
    const std::string file = written(folder.path() / "a.parquet", groups);
    EXPECT_TRUE(file.starts_with("PAR1"));
    EXPECT_TRUE(file.ends_with("PAR1"));
    const size_t footer = footer_bytes(file);
    ASSERT_LE(footer, file.size() - 12);
    EXPECT_EQ(file[file.size() - 9], '\0') << "the end of a struct";
    EXPECT_EQ(groups == 0, footer == file.size() - 12) << "no rows: a footer alone";
  }
}

TEST(ParquetFile, TheSameRowsMakeTheSameBytes) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(written(folder.path() / "a.parquet", 2), written(folder.path() / "b.parquet", 2));
}

TEST(ParquetFile, NothingIsLeftWhenNotFinished) {
  const test::TemporaryFolder folder;
  {
    ParquetFile file(folder.path() / "a.parquet", columns(), {}, "ream version 1.2.3");
    file.add(batch_of(10));
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{});
}

TEST(ParquetFile, UnwritablePlacesAreNamed) {
  const test::TemporaryFolder folder;
  const auto place = folder.path() / "nowhere" / "a.parquet";
  test::expect_error(ErrorKind::io, place.string(), [&] { written(place, 1); });
}

}  // namespace
}  // namespace ream::tables
