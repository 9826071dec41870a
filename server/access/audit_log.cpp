#include "access/audit_log.hpp"

#include <initializer_list>

#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace ream::access {
namespace {

constexpr size_t max_readings = 20'000;
constexpr int rows_at_once = 1000;
constexpr const char* forgetting = "user.forget";

/// Of several texts together, each told from the next.
std::string fingerprint_of_all(std::initializer_list<std::string> texts) {
  std::string framed;
  for (const std::string& text : texts) framed += std::to_string(text.size()) + ":" + text;
  return fingerprint_of(framed);
}

std::string seal_of(const store::AuditRow& row) {
  return fingerprint_of_all({row.nonce, row.name, row.address, row.detail});
}

std::string chain_of(const std::string& previous, const store::AuditRow& row) {
  return fingerprint_of_all({previous, std::to_string(row.number), row.at_utc, row.user_id, row.role,
                             row.credential, row.action, row.object, row.seal});
}

void link_row(const std::string& previous, store::AuditRow& row) {
  row.nonce = random_id() + random_id();
  row.seal = seal_of(row);
  row.chain = chain_of(previous, row);
}

/// Goes through the rows from the first to the last.
class ChainReader {
 public:
  explicit ChainReader(store::AuditHead expected) : expected_(std::move(expected)) {}

  void read(const store::AuditRow& row) {
    const std::string name = "row " + std::to_string(row.number);
    ++check_.rows;
    if (row.nonce.empty())
      read_anonymous(row);
    else if (row.seal != seal_of(row))
      fault(name + ": name, address or detail was changed");
    if (row.chain != chain_of(check_.head.chain, row))
      fault(row.number > check_.head.number + 1
                ? name + ": was changed, or rows between " + std::to_string(check_.head.number) +
                      " and it are missing"
                : name + ": was changed, put in, or the row before it was");
    if (row.number == expected_.number && row.chain != expected_.chain)
      fault(name + ": is not the one that was written down");
    if (row.action == forgetting) last_forgetting_ = row.number;
    check_.head = {row.number, row.chain};
  }

  AuditCheck finish(const std::optional<store::AuditHead>& head) {
    const std::string last = "row " + std::to_string(check_.head.number);
    if (!head && check_.rows > 0)
      fault(last + ": the head of the chain is missing behind it");
    else if (head && (head->number != check_.head.number || head->chain != check_.head.chain))
      fault(last + ": rows behind it are missing; the log had come to row " + std::to_string(head->number));
    if (expected_.number > check_.head.number)
      fault(last + ": rows behind it are missing; row " + std::to_string(expected_.number) +
            " was written down");
    if (last_anonymous_ > last_forgetting_)
      fault("row " + std::to_string(last_anonymous_) + ": is anonymous, and nobody was forgotten after it");
    return check_;
  }

 private:
  void read_anonymous(const store::AuditRow& row) {
    ++check_.anonymous;
    last_anonymous_ = row.number;
    if (!row.name.empty() || !row.address.empty() || !row.detail.empty())
      fault("row " + std::to_string(row.number) + ": name, address or detail was changed");
  }
  void fault(const std::string& line) { check_.faults.push_back(line); }

  const store::AuditHead expected_;
  AuditCheck check_;
  int64_t last_anonymous_ = 0, last_forgetting_ = 0;
};

}  // namespace

AuditLog::AuditLog(store::Database& database, WallClock now)
    : table_(database, link_row), now_(std::move(now)) {}

void AuditLog::write(const Actor& actor, const std::string& action, const std::string& object,
                     const std::string& detail, bool take_back) {
  const store::AuditRow row{
      0,      utc_text(now_()), actor.user_id, actor.name, actor.role, actor.credential, actor.address,
      action, object,           detail};
  try {
    take_back ? table_.try_to_add(row) : table_.add(row);
  } catch (const Error& failure) {
    log::error("not in the audit log: " + action + " " + object + " by '" + actor.name +
               "': " + failure.what());
    throw Error(
        ErrorKind::unavailable,
        std::string("the audit log cannot be written, so nothing may be done now: ") + failure.what());
  }
}

void AuditLog::note(const Actor& actor, const std::string& action, const std::string& object,
                    const std::string& detail) {
  write(actor, action, object, detail, false);
}

void AuditLog::note_reading(const Actor& actor, const std::string& action, const std::string& object) {
  const std::string& reader = actor.credential.empty() ? actor.address : actor.credential;
  const std::string key = reader + " " + action + " " + object;
  {
    const std::lock_guard lock(mutex_);
    if (readings_.contains(key)) return;
  }
  note(actor, action, object, "");
  const std::lock_guard lock(mutex_);
  if (readings_.size() >= max_readings) readings_.clear();
  readings_.insert(key);
}

void AuditLog::require_writable() { write({}, "", "", "", true); }

AuditCheck AuditLog::check(const store::AuditHead& expected) const {
  ChainReader reader(expected);
  const auto head = table_.head();
  int64_t after = 0;
  for (auto rows = table_.list_from(after, rows_at_once); !rows.empty();
       rows = table_.list_from(after, rows_at_once))
    for (const store::AuditRow& row : rows) {
      if (head && row.number > head->number) return reader.finish(head);  // came while this was read
      reader.read(row);
      after = row.number;
    }
  return reader.finish(head);
}

int64_t AuditLog::forget(const std::string& user_id, const std::vector<std::string>& names) {
  return table_.make_anonymous(user_id, names);
}

}  // namespace ream::access
