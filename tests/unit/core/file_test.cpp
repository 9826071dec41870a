#include "core/file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream {
namespace {

using test::expect_error;

/// While it lives, no file can grow past the limit: writing fails as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    previous_handler_ = ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit limit{bytes, previous_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &previous_);
    ::signal(SIGXFSZ, previous_handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit previous_{};
  sighandler_t previous_handler_ = nullptr;
};

TEST(File, AFolderThatCannotBeSyncedIsSaid) {
  const test::TemporaryFolder folder;
  EXPECT_NO_THROW(sync_folder(folder.path()));
  EXPECT_NO_THROW(sync_folder({})) << "the present one";
  expect_error(ErrorKind::io, "cannot sync folder", [&] { sync_folder(folder.path() / "missing"); });
  EXPECT_NO_THROW(sync_folder("/proc/self/fd")) << "a file system that cannot promise it";
}

TEST(File, ReadsBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  std::string text(70'000, 'x');
  for (size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * 31 + i / 256);
  write_file_atomically(folder.path() / "a", text);
  EXPECT_EQ(read_text_file(folder.path() / "a"), text);
  const auto bytes = read_binary_file(folder.path() / "a");
  ASSERT_EQ(bytes.size(), text.size());
  EXPECT_EQ(std::memcmp(bytes.data(), text.data(), text.size()), 0);
}

TEST(File, ReplacesAsAWholeAndLeavesNoTemporary) {
  const test::TemporaryFolder folder;
  write_file_atomically(folder.path() / "a", std::string_view("long old text"));
  write_file_atomically(folder.path() / "a", std::string_view("new"));
  EXPECT_EQ(read_text_file(folder.path() / "a"), "new");
  write_file_atomically(folder.path() / "a", std::string_view());
  EXPECT_EQ(read_text_file(folder.path() / "a"), "");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"a"});
}

TEST(File, AFullDiskLeavesTheOldFileAndNoTemporary) {
  const test::TemporaryFolder folder;
  write_file_atomically(folder.path() / "a", std::string_view("old"));
  {
    const FileSizeLimit limit(10'000);
    expect_error(ErrorKind::io, (folder.path() / "a").string(),
                 [&] { write_file_atomically(folder.path() / "a", std::string(100'000, 'x')); });
  }
  EXPECT_EQ(read_text_file(folder.path() / "a"), "old");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"a"});
}

TEST(File, RefusesPlacesThatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("file", "text");
  expect_error(ErrorKind::io, "missing",
               [&] { write_file_atomically(folder.path() / "missing" / "a", std::string_view("x")); });
  expect_error(ErrorKind::io, "file", [&] { write_file_atomically(file / "a", std::string_view("x")); });
  std::filesystem::create_directory(folder.path() / "taken");
  expect_error(ErrorKind::io, "taken",
               [&] { write_file_atomically(folder.path() / "taken", std::string_view("x")); });
  ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/null", folder.path() / "nothing");
  for (const char* name : {"pipe", "nothing"}) {
    expect_error(ErrorKind::io, std::string(name) + ": it is no file",
                 [&] { write_file_atomically(folder.path() / name, std::string_view("x")); });
    EXPECT_FALSE(std::filesystem::is_regular_file(folder.path() / name));
  }
  expect_error(ErrorKind::io, "/proc", [&] { make_writable_folder("/proc/ream-test"); });
  expect_error(ErrorKind::io, "file", [&] { make_writable_folder(file); });
  EXPECT_EQ(folder.entries().size(), 4u);
}

TEST(File, RefusesAFolderWithoutWritePermission) {
  const test::TemporaryFolder folder;
  ::chmod(folder.path().c_str(), 0555);
  const uid_t user = ::geteuid();
  constexpr uid_t nobody = 65534;
  if (user == 0) {  // who may write everywhere
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  expect_error(ErrorKind::io, folder.path().string(),
               [&] { write_file_atomically(folder.path() / "a", std::string_view("x")); });
  expect_error(ErrorKind::io, folder.path().string(), [&] { make_writable_folder(folder.path()); });
  EXPECT_EQ(::seteuid(user), 0);
  ::chmod(folder.path().c_str(), 0755);
  EXPECT_TRUE(folder.entries().empty());
}

TEST(File, MakesFoldersWithTheirParents) {
  const test::TemporaryFolder folder;
  make_writable_folder(folder.path() / "a" / "b");
  make_writable_folder(folder.path() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "a" / "b"));
}

TEST(File, TellsWhyItCannotRead) {
  const test::TemporaryFolder folder;
  expect_error(ErrorKind::not_found, "absent", [&] { read_text_file(folder.path() / "absent"); });
  expect_error(ErrorKind::invalid_input, "folder", [&] { read_binary_file(folder.path()); });
}

TEST(File, NamesTheFileAndPlaceOfBadJson) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_json_file(folder.write("good.json", "{\"a\": [1, 2]}")).at("a").at(1), 2);
  for (const char* text : {"", "{", "{\"a\": 1,}", "{\"a\": nan}", "[1, 2] x", "\xff\xfe"})
    expect_error(ErrorKind::invalid_input, "bad.json is not valid JSON",
                 [&] { read_json_file(folder.write("bad.json", text)); });
  expect_error(ErrorKind::invalid_input, "line 2",
               [&] { read_json_file(folder.write("bad.json", "{\n\"a\" 1}")); });
}

}  // namespace
}  // namespace ream
