#pragma once
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "core/utc.hpp"
#include "net/router.hpp"
#include "store/idempotency_table.hpp"

namespace ream::api {

/// Lets a sender repeat a request that makes something (its answer was lost, say) without making it twice:
/// requests with the same Idempotency-Key of the same caller get the same answer for a day. Kept in the
/// database, or without one in memory. Thread-safe.
class Idempotency {
 public:
  static constexpr std::chrono::hours kept_for{24};
  static constexpr const char* header = "idempotency-key";

  /// `database` null: in memory, the newest few thousand.
  explicit Idempotency(std::shared_ptr<store::Database> database, WallClock now = machine_clock());

  /// What next(request) answers, or what it answered before. Only success is kept: what failed may be tried
  /// again. RequestErrors: 400 for a key that is none, 422 when it was used for another request, 409 while
  /// the first is under way. Error unavailable while the database cannot be asked.
  net::Response answer(const net::Request& request, const net::Handler& next);

  /// Forgets what is older than a day.
  void forget_old();

 private:
  using Name = std::pair<std::string, std::string>;  ///< caller and key
  std::optional<store::StoredResponse> find(const Name& name) const;
  void keep(const Name& name, const std::string& request, const net::Response& response);
  int64_t oldest_ms() const;

  const std::shared_ptr<store::Database> database_;
  const WallClock now_;
  mutable std::mutex mutex_;
  std::set<Name> under_way_;
  std::map<Name, store::StoredResponse> remembered_;  ///< without a database
};

}  // namespace ream::api
