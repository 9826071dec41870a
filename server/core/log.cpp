#include "core/log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>

namespace ream::log {
namespace {

/// systemd names device and inode of what it reads as the journal: sd-journal, JOURNAL_STREAM.
bool writes_to_journal() {
  const char* stream = std::getenv("JOURNAL_STREAM");
  struct stat status {};
  return stream != nullptr && ::fstat(STDERR_FILENO, &status) == 0 &&
         std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino) == stream;
}

/// A line's level as syslog numbers them.
class SyslogLevel : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& line, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    out.push_back(line.level >= spdlog::level::err ? '3' : line.level >= spdlog::level::warn ? '4' : '6');
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<SyslogLevel>(); }
};

/// A line's text as a JSON string.
class JsonText : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& line, const std::tm& /*time*/,
              spdlog::memory_buf_t& out) override {
    const nlohmann::json text = std::string(line.payload.data(), line.payload.size());
    const std::string quoted = text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    out.append(quoted.data(), quoted.data() + quoted.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<JsonText>(); }
};

std::unique_ptr<spdlog::formatter> formatter(Format format) {
  if (format == Format::automatic) format = writes_to_journal() ? Format::journal : Format::text;
  if (format == Format::text)
    return std::make_unique<spdlog::pattern_formatter>("%Y-%m-%d %H:%M:%S.%e %z %^%l%$ %v");
  if (format == Format::journal) {
    auto made = std::make_unique<spdlog::pattern_formatter>();
    made->add_flag<SyslogLevel>('*').set_pattern("<%*>%v");
    return made;
  }
  auto made = std::make_unique<spdlog::pattern_formatter>(spdlog::pattern_time_type::utc);
  made->add_flag<JsonText>('*').set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%eZ","level":"%l","text":%*})");
  return made;
}

spdlog::logger& logger() {
  static const auto instance = [] {
    auto made =
        std::make_shared<spdlog::logger>("ream", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    made->set_formatter(formatter(Format::automatic));
    return made;
  }();
  return *instance;
}

}  // namespace

void info(const std::string& line) { logger().info(line); }
void warn(const std::string& line) { logger().warn(line); }
void error(const std::string& line) { logger().error(line); }

void set_format(Format format) { logger().set_formatter(formatter(format)); }

void current_exception(const char* what) noexcept try {
  try {
    throw;
  } catch (const std::exception& failure) {
    error(std::string(what) + ": " + failure.what());
  } catch (...) {
    error(std::string(what) + ": an exception without words");
  }
} catch (...) {
  return;
}

}  // namespace ream::log
