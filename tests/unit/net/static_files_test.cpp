#include "net/static_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream::net {
namespace fs = std::filesystem;
namespace {

class StaticFilesTest : public testing::Test {
 protected:
  StaticFilesTest() {
    fs::remove_all(folder);
    fs::create_directories(root / "assets");
    write_file_atomically(folder / "secret.txt", std::string_view("secret"));
    write_file_atomically(root / "index.html", std::string_view("<html>"));
    write_file_atomically(root / ".hidden", std::string_view("hidden"));
    write_file_atomically(root / "assets" / "app-1234.js", std::string_view("run()"));
    fs::create_symlink(folder / "secret.txt", root / "link.txt");
  }
  ~StaticFilesTest() override { fs::remove_all(folder); }

  Response get(const std::string& path, const std::string& known_tag = {}) const {
    Request request;
    request.method = "GET";
    request.path = path;
    if (!known_tag.empty()) request.headers["if-none-match"] = known_tag;
    return StaticFiles(root).respond(request);
  }

  const fs::path folder = fs::temp_directory_path() / ("ream-static-" + std::to_string(::getpid()));
  const fs::path root = folder / "web";
};

TEST_F(StaticFilesTest, ServesWithTypeAndCaching) {
  const Response page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.content_type, "text/html; charset=utf-8");
  EXPECT_EQ(page.header("Cache-Control"), "no-cache");
  const Response script = get("/assets/app-1234.js");
  EXPECT_EQ(script.content_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(script.header("Cache-Control"), "public, max-age=31536000, immutable");
  EXPECT_EQ(script.body->size(), 5u);
}

TEST_F(StaticFilesTest, APageIsFoundWithoutItsEnding) {
  write_file_atomically(root / "api.html", std::string_view("<html>api"));
  write_file_atomically(folder / "outside.html", std::string_view("<html>secret"));
  EXPECT_EQ(get("/api").content_type, "text/html; charset=utf-8");
  EXPECT_EQ(get("/api").body->size(), 9u);
  EXPECT_EQ(get("/api", std::string(get("/api").header("ETag"))).status, 304);
  fs::create_directories(root / "docs");
  write_file_atomically(root / "docs.html", std::string_view("<html>docs"));
  write_file_atomically(root / "docs" / "index.html", std::string_view("<html>all papers"));
  EXPECT_EQ(get("/docs").body->size(), 10u);
  EXPECT_EQ(get("/docs/").body->size(), 16u);
  for (const char* path : {"/api/", "/assets", "/assets/app-1234", "/../outside", "/apis"})
    EXPECT_THROW(get(path), Error) << path;
}

TEST_F(StaticFilesTest, KnownTagIs304UntilTheFileChanges) {
  const std::string tag(get("/index.html").header("ETag"));
  ASSERT_FALSE(tag.empty());
  const Response same = get("/index.html", tag);
  EXPECT_EQ(same.status, 304);
  EXPECT_EQ(same.body, nullptr);
  write_file_atomically(root / "index.html", std::string_view("<html>more"));
  EXPECT_EQ(get("/index.html", tag).status, 200);
}

TEST_F(StaticFilesTest, NothingOutsideTheFolderIsServed) {
  for (const char* path : {"/../secret.txt", "/assets/../../secret.txt", "/..", "/.", "/./index.html",
                           "/.hidden", "//etc/passwd", "/assets//app-1234.js", "/link.txt", "/assets",
                           "/assets/", "/missing.js", "/index.html/"}) {
    try {
      get(path);
      ADD_FAILURE() << path << " was served";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::not_found) << path;
    }
  }
}

TEST(StaticFiles, MissingFolderIsNotFoundAndNoFailure) {
  Request request;
  request.path = "/";
  EXPECT_THROW(StaticFiles("/no/such/folder").respond(request), Error);
}

}  // namespace
}  // namespace ream::net
