#include "workup/upload_store.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/file.hpp"
#include "net/problem.hpp"
#include "support/temporary_folder.hpp"

namespace ream::workup {
namespace {

class UploadStoreTest : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  UploadStore store{folder.path() / "uploads", {1000, 2000, 3}};
};

ErrorKind kind_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorKind::usage;
}

TEST_F(UploadStoreTest, PiecesMakeTheFile) {
  const Upload begun = store.create("shoulder.zip", 10);
  EXPECT_EQ(begun.received, 0u);
  EXPECT_EQ(store.append(begun.id, 0, "01234").received, 5u);
  EXPECT_EQ(kind_of([&] { store.append(begun.id, 0, "01234"); }), ErrorKind::conflict);
  EXPECT_EQ(kind_of([&] { store.append(begun.id, 5, "567890"); }), ErrorKind::conflict)
      << "one byte too many";
  EXPECT_EQ(kind_of([&] { store.take(begun.id); }), ErrorKind::conflict) << "it is not complete";
  EXPECT_EQ(store.append(begun.id, 5, "56789").received, 10u);
  const auto file = store.take(begun.id);
  EXPECT_EQ(read_text_file(file), "0123456789");
  EXPECT_EQ(file.filename(), "shoulder.zip");
  EXPECT_EQ(kind_of([&] { store.get(begun.id); }), ErrorKind::not_found);
}

TEST_F(UploadStoreTest, NamesArePlainFileNamesOfCts) {
  for (const char* good : {"a.zip", "Series 3.ZIP", "a.nii.gz", "a.NRRD", "a.mha", "rows.txt", "a.dcm"})
    EXPECT_NO_THROW(store.remove(store.create(good, 1).id)) << good;
  const std::vector<std::string> refused = {"",        ".zip",     "../a.zip",
                                            "a/b.zip", "a\\b.zip", "a.exe",
                                            "zip",     "a\n.zip",  std::string(300, 'a') + ".zip"};
  for (const std::string& bad : refused) EXPECT_THROW(store.create(bad, 1), net::RequestError) << bad;
}

TEST_F(UploadStoreTest, LimitsHoldForOneFileAndForAll) {
  EXPECT_THROW(store.create("a.zip", 1001), net::RequestError);
  store.create("a.zip", 1000);
  const Upload second = store.create("b.zip", 999);
  EXPECT_THROW(store.create("c.zip", 2), net::RequestError) << "2,000 bytes in all";
  store.create("c.zip", 1);
  EXPECT_THROW(store.create("d.zip", 0), net::RequestError) << "three at once";
  store.remove(second.id);
  EXPECT_NO_THROW(store.create("d.zip", 999));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "uploads" / second.id));
}

TEST_F(UploadStoreTest, WhatAnEarlierServerLeftIsRemoved) {
  folder.write("old/abc/a.zip", "half");
  const UploadStore next(folder.path() / "old");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "old"));
}

TEST_F(UploadStoreTest, WhatNobodyGoesOnWithIsRemoved) {
  const auto begun = store.create("DOE_Jane.zip", 4);
  const auto now = UploadStore::Clock::now();
  store.remove_idle(now + std::chrono::hours(23));
  EXPECT_EQ(store.list().size(), 1u);
  store.append(begun.id, 0, "ab");
  store.remove_idle(now + std::chrono::hours(25));
  EXPECT_TRUE(store.list().empty());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "uploads" / begun.id));
  EXPECT_EQ(kind_of([&] { store.append(begun.id, 2, "cd"); }), ErrorKind::not_found);
}

}  // namespace
}  // namespace ream::workup
