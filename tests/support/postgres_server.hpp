#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ream::test {

/// A PostgreSQL server of the tests' own, in a temporary folder, on loopback and a free port, that keeps
/// nothing safe. Ends with its owner, or when the test's process dies. Failures throw std::runtime_error.
class PostgresServer {
 public:
  PostgresServer();
  ~PostgresServer();
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// The one that all tests of this process share, started when it is first asked for.
  static PostgresServer& shared();

  /// URL of a new, empty database.
  std::string make_database();

  uint16_t port() const { return port_; }
  /// Ends the server at once, with every connection.
  void stop();
  /// Starts it again with all that it held, on the same port.
  void start();
  /// It keeps its connections and answers nothing, until it goes on.
  void hang();
  void go_on();

 private:
  std::filesystem::path folder_;
  uint16_t port_ = 0;
  int process_ = -1;
  int databases_ = 0;
  std::vector<int> hanging_;  ///< its processes
};

}  // namespace ream::test
