#include "store/zip_archive.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::store {
namespace {

class ZipArchive : public testing::Test {
 protected:
  std::filesystem::path zipped(const std::vector<std::string>& names) {
    std::vector<ArchiveEntry> entries;
    for (const std::string& name : names) entries.push_back({file_, name});
    write_zip(folder_.path() / "a.zip", entries);
    std::filesystem::create_directory(out());
    return folder_.path() / "a.zip";
  }
  std::filesystem::path out() const { return folder_.path() / "out"; }
  void refuse(const std::vector<std::string>& names, const std::string& mentioned,
              const UnpackLimits& limits = {}) {
    test::expect_error(ErrorKind::invalid_input, mentioned,
                       [&] { unpack_zip(zipped(names), out(), limits); });
    EXPECT_TRUE(std::filesystem::is_empty(out())) << "nothing is unpacked of what is refused";
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.write("one", "1");
};

std::string deep(size_t folders, const std::string& part = "a") {
  std::string name;
  for (size_t i = 0; i < folders; ++i) name += part + "/";
  return name + "x";
}

TEST_F(ZipArchive, FoldersAreNotDeeperThanAnyBodyNeeds) {
  unpack_zip(zipped({deep(15)}), out());
  EXPECT_TRUE(std::filesystem::exists(out() / deep(15)));
  std::filesystem::remove_all(out());
  refuse({deep(16)}, "too deep");
  std::filesystem::remove_all(out());
  refuse({deep(2000)}, "too deep");
  std::filesystem::remove_all(out());
  refuse({deep(4, std::string(300, 'b'))}, "too deep");
}

TEST_F(ZipArchive, FoldersCountAsFilesDo) {
  std::vector<std::string> names;
  for (char c = 'a'; c <= 'j'; ++c) names.push_back(std::string(1, c) + "/" + deep(9));
  UnpackLimits limits;
  limits.entries = 110;  // 10 files in 10 folders each
  unpack_zip(zipped(names), out(), limits);
  std::filesystem::remove_all(out());
  limits.entries = 109;
  refuse(names, "one folder too many", limits);
}

}  // namespace
}  // namespace ream::store
