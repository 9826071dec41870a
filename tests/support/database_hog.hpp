#pragma once
#include <latch>
#include <thread>

#include "core/error.hpp"
#include "store/database.hpp"

namespace ream::test {

/// Keeps the only connection of a database to itself, so that all others wait for one in vain.
class DatabaseHog {
 public:
  explicit DatabaseHog(store::Database& database) : thread_([this, &database] { hold(database); }) {
    held_.wait();
  }
  ~DatabaseHog() {
    released_.count_down();
    thread_.join();
  }

 private:
  void hold(store::Database& database) {
    for (bool holds = false; !holds;) try {
        database.read([&](store::Sql&) {
          holds = true;
          held_.count_down();
          released_.wait();
        });
      } catch (const Error&) {  // somebody else has it for a moment
      }
  }

  std::latch held_{1}, released_{1};
  std::thread thread_;
};

}  // namespace ream::test
