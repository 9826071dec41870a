#include "core/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>

namespace ream::log {
namespace {

spdlog::logger& logger() {
  static const auto instance = [] {
    auto made =
        std::make_shared<spdlog::logger>("ream", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    made->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    return made;
  }();
  return *instance;
}

}  // namespace

void info(const std::string& line) { logger().info(line); }
void warn(const std::string& line) { logger().warn(line); }
void error(const std::string& line) { logger().error(line); }

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
