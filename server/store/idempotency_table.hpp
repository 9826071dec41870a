#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "store/database.hpp"

namespace ream::store {

/// What was answered to a request that its sender may repeat.
struct StoredResponse {
  std::string caller, key;  ///< whose request it was, and what its sender called it
  std::string request;      ///< tells different requests apart
  int status = 0;
  std::string content_type, location, body;
  int64_t at_ms = 0;  ///< since 1970

  bool operator==(const StoredResponse&) const = default;
};

/// Answers by caller and key. Thread-safe; errors are those of Database.
class IdempotencyTable {
 public:
  /// Most of one caller; the oldest ones give way.
  static constexpr int64_t max_answers = 1000, max_bytes = 8 << 20;

  explicit IdempotencyTable(Database& database) : database_(database) {}

  std::optional<StoredResponse> find(const std::string& caller, const std::string& key) const;
  /// Takes the place of one with the same caller and key.
  void put(const StoredResponse& answer);
  void remove_before(int64_t at_ms);
  /// Answers that hold this id: of a session or a person that is to be forgotten.
  void remove_about(const std::string& id);

 private:
  Database& database_;
};

}  // namespace ream::store
