#include "core/log.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <regex>

namespace ream {
namespace {

/// What the log writes in that form, with stderr a file meanwhile.
class Log : public testing::Test {
 protected:
  ~Log() override {
    ::unsetenv("JOURNAL_STREAM");
    log::set_format(log::Format::automatic);
  }
  static std::string written(log::Format format, void (*write)(const std::string&), const std::string& text) {
    testing::internal::CaptureStderr();
    log::set_format(format);
    write(text);
    return testing::internal::GetCapturedStderr();
  }
};

TEST_F(Log, LinesOfTextHaveDateTimeZoneAndLevel) {
  const std::regex line(R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} [+-]\d\d:\d\d warning the case is gone\n)");
  EXPECT_TRUE(std::regex_match(written(log::Format::text, log::warn, "the case is gone"), line));
}

TEST_F(Log, TheJournalGetsLevelsAsSyslogNumbersThem) {
  EXPECT_EQ(written(log::Format::journal, log::info, "a"), "<6>a\n");
  EXPECT_EQ(written(log::Format::journal, log::warn, "b"), "<4>b\n");
  EXPECT_EQ(written(log::Format::journal, log::error, "c"), "<3>c\n");
}

TEST_F(Log, TheJournalIsKnownByDeviceAndInode) {
  testing::internal::CaptureStderr();
  struct stat status {};
  ASSERT_EQ(::fstat(STDERR_FILENO, &status), 0);
  const std::string stream = std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  ::setenv("JOURNAL_STREAM", stream.c_str(), 1);
  log::set_format(log::Format::automatic);
  log::info("read by the journal");
  ::setenv("JOURNAL_STREAM", (stream + "0").c_str(), 1);
  log::set_format(log::Format::automatic);
  log::info("of another service");
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(lines.starts_with("<6>read by the journal\n")) << lines;
  EXPECT_NE(lines.find(" info of another service\n"), std::string::npos) << lines;
}

TEST_F(Log, EachLineOfJsonIsAnObject) {
  const std::string foreign = "it said \"no\"\n\x01 and \xff";
  const std::string line = written(log::Format::json, log::error, foreign);
  EXPECT_EQ(line.find('\n'), line.size() - 1) << line;
  const auto object = nlohmann::json::parse(line);
  EXPECT_EQ(object.at("level"), "error");
  EXPECT_EQ(object.at("text").get<std::string>().substr(0, 14), foreign.substr(0, 14));
  EXPECT_TRUE(std::regex_match(object.at("time").get<std::string>(),
                               std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")));
}

}  // namespace
}  // namespace ream
