#pragma once
#include <chrono>
#include <map>
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
/// database, for each caller the last 1000 answers of at most 256 KiB. Thread-safe.
class Idempotency {
 public:
  enum class Place {
    database,
    memory,  ///< the last 1000 of all callers, until the server ends: answers that no disk may keep
  };
  static constexpr std::chrono::hours kept_for{24};
  static constexpr size_t max_key_length = 200;
  static constexpr const char* header = "idempotency-key";

  /// `database` outlives it.
  explicit Idempotency(store::Database& database, WallClock now = machine_clock())
      : table_(database), now_(std::move(now)) {}

  /// What next(request) answers, or what it answered before. Only success is kept: what failed may be tried
  /// again. RequestErrors: 400 for a key that is none, 422 when it was used for another request, 409 while
  /// the first is under way. Error unavailable while the database cannot be asked.
  net::Response answer(const net::Request& request, const net::Handler& next, Place place = Place::database);

  /// Forgets what is older than a day.
  void forget_old();
  /// Forgets the answers that tell of a session that was erased, or were given to or tell of a user who is
  /// gone.
  void forget_about(const std::string& id);

 private:
  using Name = std::pair<std::string, std::string>;  ///< caller and key
  std::optional<store::StoredResponse> find(const Name& name);
  void keep(const Name& name, const std::string& request, const net::Response& response, Place place);
  int64_t oldest_ms() const;

  store::IdempotencyTable table_;
  const WallClock now_;
  std::mutex mutex_;
  std::set<Name> under_way_;
  std::map<Name, store::StoredResponse> in_memory_;
};

}  // namespace ream::api
