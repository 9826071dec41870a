#include "net/file_body.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace ream::net {
namespace {

class FileBodyTest : public testing::Test {
 protected:
  Response get(const std::map<std::string, std::string>& headers = {},
               const std::string& method = "GET") const {
    Request request;
    request.method = method;
    request.headers = headers;
    return file_response(request, {path, "application/octet-stream", {}});
  }
  static std::string text_of(const Response& response) {
    Bytes bytes(response.file->bytes);
    EXPECT_EQ(response.file->file->read(response.file->offset, bytes), bytes.size());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.write("file.bin", "0123456789");
};

TEST_F(FileBodyTest, WholeFileWithTagAndRanges) {
  const Response response = get();
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.content_type, "application/octet-stream");
  EXPECT_EQ(response.header("Accept-Ranges"), "bytes");
  EXPECT_EQ(response.body_bytes(), 10u);
  EXPECT_EQ(text_of(response), "0123456789");
  EXPECT_TRUE(response.header("Content-Disposition").empty());
}

TEST_F(FileBodyTest, OneRangeIsPartial) {
  const Response response = get({{"range", "bytes=3-5"}});
  EXPECT_EQ(response.status, 206);
  EXPECT_EQ(response.header("Content-Range"), "bytes 3-5/10");
  EXPECT_EQ(response.body_bytes(), 3u);
  EXPECT_EQ(text_of(response), "345");
  EXPECT_EQ(get({{"range", "bytes=3-5"}}, "HEAD").status, 200);
}

TEST_F(FileBodyTest, RangeOutsideIs416) {
  const Response response = get({{"range", "bytes=10-"}});
  EXPECT_EQ(response.status, 416);
  EXPECT_EQ(response.header("Content-Range"), "bytes */10");
  EXPECT_EQ(response.content_type, "application/problem+json");
}

TEST_F(FileBodyTest, RangeGoesOnOnlyWithTheSameFile) {
  const std::string tag(get().header("ETag"));
  EXPECT_EQ(get({{"range", "bytes=3-"}, {"if-range", tag}}).status, 206);
  EXPECT_EQ(get({{"range", "bytes=3-"}, {"if-range", "W/" + tag}}).status, 200);
  EXPECT_EQ(get({{"range", "bytes=3-"}, {"if-range", "Wed, 21 Oct 2015 07:28:00 GMT"}}).status, 200);
  write_file_atomically(path, std::string_view("9876543210"));
  EXPECT_NE(get().header("ETag"), tag);
  EXPECT_EQ(get({{"range", "bytes=3-"}, {"if-range", tag}}).status, 200);
}

TEST_F(FileBodyTest, KnownTagIs304) {
  const Response response =
      get({{"if-none-match", std::string(get().header("ETag"))}, {"range", "bytes=0-1"}});
  EXPECT_EQ(response.status, 304);
  EXPECT_EQ(response.body_bytes(), 0u);
}

TEST_F(FileBodyTest, WhatWasOpenedStaysReadable) {
  const Response response = get();
  write_file_atomically(path, std::string_view("another"));
  EXPECT_EQ(text_of(response), "0123456789");
  std::filesystem::remove(path);
  EXPECT_EQ(text_of(response), "0123456789");
}

TEST_F(FileBodyTest, WhatIsNoFileIsRefused) {
  test::expect_error(ErrorKind::not_found, "missing.bin", [&] { OpenFile(folder.path() / "missing.bin"); });
  test::expect_error(ErrorKind::not_found, "file.bin/x", [&] { OpenFile(path / "x"); });
  test::expect_error(ErrorKind::invalid_input, "is no file", [&] { OpenFile(folder.path()); });
  const std::filesystem::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  test::expect_error(ErrorKind::invalid_input, "is no file", [&] { OpenFile{pipe}; });
}

TEST(AttachmentName, AnyNameIsSafeInTheHeader) {
  EXPECT_EQ(attachment_named("recording.ream"),
            "attachment; filename=\"recording.ream\"; filename*=UTF-8''recording.ream");
  EXPECT_EQ(attachment_named("a \"b\"\r\n\xC3\xA9"),
            "attachment; filename=\"a__b_____\"; filename*=UTF-8''a%20%22b%22%0D%0A%C3%A9");
}

}  // namespace
}  // namespace ream::net
