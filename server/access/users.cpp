#include "access/users.hpp"

#include <algorithm>

#include "access/password_hasher.hpp"
#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/text.hpp"

namespace ream::access {
namespace {

constexpr size_t max_name_length = 64, max_display_name_bytes = 400;
constexpr auto ask_interval = std::chrono::seconds(1);

User user_of(const store::UserRow& row) {
  return {row.id,      row.name,       row.display_name, role_from(row.role).value_or(Role::viewer),
          row.enabled, row.created_utc};
}

void require_account_role(Role role) {
  if (role == Role::viewer)
    throw Error(ErrorKind::invalid_input, "a user is operator, instructor or trainee; viewers have links");
}

void require_display_name(const std::string& name) {
  if (name.size() > max_display_name_bytes || !is_plain_line(name))
    throw Error(ErrorKind::invalid_input,
                "a name to show is one line of at most " + std::to_string(max_display_name_bytes) + " bytes");
}

}  // namespace

bool is_plain_line(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; });
}

bool is_user_name(const std::string& name) {
  return !name.empty() && name.size() <= max_name_length &&
         name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._@-") == std::string::npos;
}

void require_user_name(const std::string& name) {
  if (!is_user_name(name))
    throw Error(ErrorKind::invalid_input, "a user's name may hold only a-z, 0-9 and . _ @ -, and at most " +
                                              std::to_string(max_name_length) + " of them");
}

Users::Users(store::Database& database, PasswordHasher& hasher, Credentials& credentials,
             LoginBackoff& backoff, WallClock now)
    : table_(database, to_text(Role::operator_)),
      hasher_(hasher),
      credentials_(credentials),
      backoff_(backoff),
      now_(std::move(now)) {}

bool Users::any() {
  if (any_) return true;
  const std::lock_guard lock(mutex_);
  const auto now = SteadyClock::now();
  if (any_ || (last_asked_ && now - *last_asked_ < ask_interval)) return any_;
  if (table_.any()) any_ = true;
  last_asked_ = now;
  return any_;
}

User Users::add(const NewUser& user) {
  const std::string name = lower(user.name);
  require_user_name(name);
  require_display_name(user.display_name);
  require_account_role(user.role);
  require_good_password(user.password, name);
  if (table_.find_by_name(name)) throw Error(ErrorKind::conflict, "there is a user '" + name + "' already");
  store::UserRow row;
  row.id = random_id();
  row.name = name;
  row.display_name = user.display_name.empty() ? name : user.display_name;
  row.role = to_text(user.role);
  row.created_utc = utc_text(now_());
  row.password_hash = hasher_.hash(user.password);
  const store::UserTable::Added added = table_.add(row);
  any_ = true;
  if (added.first) credentials_.end_open_beginning(added.ended);
  return user_of(row);
}

User Users::change(const std::string& id, const UserChange& change) {
  if (change.role) require_account_role(*change.role);
  if (change.display_name) require_display_name(*change.display_name);
  std::string hash;
  if (change.password) {
    require_good_password(*change.password, get(id).name);
    hash = hasher_.hash(*change.password);
  }
  const User changed = user_of(table_.change(id, [&](store::UserRow& row) {
    if (change.display_name)
      row.display_name = change.display_name->empty() ? row.name : *change.display_name;
    if (change.role) row.role = to_text(*change.role);
    if (change.enabled) row.enabled = *change.enabled;
    if (!hash.empty()) row.password_hash = hash;
  }));
  if (change.password) {
    credentials_.end_old_logins(id, "", change.keep_tokens);
    backoff_.forget(changed.name);
  }
  if (!changed.enabled) {
    credentials_.revoke_all(id);
  } else if (change.role) {
    if (changed.role < Role::instructor) credentials_.revoke_links(id);
    credentials_.renew(id);
  }
  return changed;
}

void Users::remove(const std::string& id) {
  table_.remove(id);
  credentials_.revoke_all(id);
}

User Users::get(const std::string& id) const {
  if (const auto row = table_.find(id)) return user_of(*row);
  throw Error(ErrorKind::not_found, "no user '" + id + "'");
}

std::optional<User> Users::find_by_name(const std::string& name) const {
  const auto row = table_.find_by_name(lower(name));
  return row ? std::optional(user_of(*row)) : std::nullopt;
}

std::vector<User> Users::list() const {
  std::vector<User> users;
  for (const store::UserRow& row : table_.list()) users.push_back(user_of(row));
  return users;
}

bool Users::check_password(const std::optional<store::UserRow>& row, const std::string& name,
                           const Secret& password, const LoginOrigin& origin) {
  backoff_.require_allowed(name, origin);
  const bool can_log_in = row && row->enabled;
  const auto verdict = hasher_.verify(password, can_log_in ? row->password_hash : "");
  if (!verdict.right) {
    backoff_.note_failure(name, origin);
    return false;
  }
  backoff_.note_success(name, origin);
  if (verdict.outdated) rehash(*row, password);
  return true;
}

void Users::rehash(const store::UserRow& row, const Secret& password) {
  try {
    const std::string hash = hasher_.hash(password);
    table_.change(row.id, [&](store::UserRow& changed) {
      if (changed.password_hash == row.password_hash) changed.password_hash = hash;
    });
  } catch (const Error& not_now) {
    log::info(std::string("a password keeps its old hash until the next login: ") + not_now.what());
  }
}

std::optional<User> Users::log_in(const std::string& typed, const Secret& password,
                                  const LoginOrigin& origin) {
  const std::string name = lower(typed);
  const auto row = is_user_name(name) ? table_.find_by_name(name) : std::nullopt;
  return check_password(row, name, password, origin) ? std::optional(user_of(*row)) : std::nullopt;
}

bool Users::change_password(const std::string& id, const PasswordChange& change, const LoginOrigin& origin) {
  const auto row = table_.find(id);
  require_good_password(change.wanted, row ? row->name : "");
  if (!check_password(row, row ? row->name : "", change.present, origin)) return false;
  const std::string hash = hasher_.hash(change.wanted);
  table_.change(id, [&](store::UserRow& changed) { changed.password_hash = hash; });
  credentials_.end_old_logins(id, change.this_login, change.keep_tokens);
  return true;
}

}  // namespace ream::access
