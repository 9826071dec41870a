#include "access/credentials.hpp"

#include <algorithm>

#include "access/secret.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace ream::access {
namespace {

using std::chrono::seconds;
constexpr seconds note_interval{60}, retention = std::chrono::hours(24 * 30);
constexpr size_t max_cached = 4096;
/// A clock that is set right by so little has not gone back.
constexpr seconds clock_tolerance{120};

/// What somebody may do with it now; none: nothing any more.
std::optional<Role> role_of(const store::KnownCredential& known) {
  const store::CredentialRow& row = known.credential;
  if (row.user_id.empty()) return role_from(row.role);
  if (!known.user || !known.user->enabled) return std::nullopt;
  const auto of_user = role_from(known.user->role);
  if (!of_user) return std::nullopt;
  if (row.kind == to_text(CredentialKind::link))
    return *of_user >= Role::instructor ? std::optional(Role::viewer) : std::nullopt;
  if (row.role.empty()) return of_user;
  const auto limit = role_from(row.role);
  return limit && may_be_limited(*of_user, *limit) ? limit : std::nullopt;
}

std::string role_column(CredentialKind kind, const NewCredential& request) {
  if (kind == CredentialKind::link || !request.parent_id.empty()) return to_text(Role::viewer);
  return request.limit ? to_text(*request.limit) : "";
}

}  // namespace

std::string to_text(CredentialKind kind) {
  switch (kind) {
    case CredentialKind::token: return "token";
    case CredentialKind::cookie: return "cookie";
    case CredentialKind::link: return "link";
  }
  return "token";
}

Credentials::Credentials(store::Database& database, WallClock now, Lifetimes lifetimes)
    : table_(database), now_(std::move(now)), lifetimes_(lifetimes) {}

std::optional<store::KnownCredential> Credentials::look_up(const std::string& id) {
  uint64_t before = 0;
  {
    const std::lock_guard lock(mutex_);
    const auto found = cache_.find(id);
    if (found != cache_.end() && SteadyClock::now() - found->second.since < cache_time)
      return found->second.known;
    before = invalidations_;
  }
  auto known = table_.find(id);
  const std::lock_guard lock(mutex_);
  if (known && before == invalidations_) {
    if (cache_.size() >= max_cached) cache_.clear();
    cache_[id] = {*known, SteadyClock::now()};
  }
  return known;
}

void Credentials::turn_back(UtcMoment now) {
  const std::string kept = table_.latest_time();
  if (!kept.empty() && utc_moment(kept) <= now + clock_tolerance) {  // another process has done so
    latest_ = latest_kept_ = now;
    const std::lock_guard lock(mutex_);
    ++invalidations_;
    cache_.clear();
    return;
  }
  const auto gone =
      table_.turn_back(utc_text(*latest_), utc_text(now), utc_text(*latest_ - lifetimes_.cookie_idle));
  log::warn("the clock went back from " + utc_text(*latest_) + " to " + utc_text(now) + "; " +
            std::to_string(gone.size()) +
            " logins, tokens and links that had ended by then or were made since then are gone");
  latest_ = latest_kept_ = now;
  invalidate(gone);
}

UtcMoment Credentials::judged_time() {
  const UtcMoment now = now_();
  const std::lock_guard lock(time_mutex_);
  if (!latest_) {
    const std::string kept = table_.latest_time();
    latest_ = latest_kept_ = kept.empty() ? UtcMoment{} : utc_moment(kept);
  }
  if (now < *latest_ - clock_tolerance) turn_back(now);
  latest_ = std::max(*latest_, now);
  if (*latest_ - latest_kept_ < note_interval) return *latest_;
  latest_kept_ = *latest_;
  try {
    table_.note_latest_time(utc_text(*latest_));
  } catch (const Error& failure) {
    log::warn(std::string("the time could not be noted in the database: ") + failure.what());
  }
  return *latest_;
}

std::optional<Identity> Credentials::identity_of(const store::KnownCredential& known, UtcMoment now) const {
  const store::CredentialRow& row = known.credential;
  if (row.expires_utc <= utc_text(now)) return std::nullopt;
  const bool is_cookie = row.kind == to_text(CredentialKind::cookie);
  if (is_cookie && row.last_used_utc < utc_text(now - lifetimes_.cookie_idle)) return std::nullopt;
  const auto role = role_of(known);
  if (!role) return std::nullopt;
  Identity identity;
  identity.credential = row.id;
  identity.kind = is_cookie                                   ? CredentialKind::cookie
                  : row.kind == to_text(CredentialKind::link) ? CredentialKind::link
                                                              : CredentialKind::token;
  if (known.user && identity.kind != CredentialKind::link) {
    identity.user_id = known.user->id;
    identity.name = known.user->name;
    identity.display_name = known.user->display_name;
  } else {
    identity.display_name = row.name;
  }
  identity.role = *role;
  identity.only_session = row.session_id;
  identity.expires_utc = row.expires_utc;
  return identity;
}

void Credentials::note_use(const store::CredentialRow& row) {
  const UtcMoment now = now_();
  if (row.last_used_utc > utc_text(now - note_interval)) return;
  const std::string used = utc_text(now);
  {
    const std::lock_guard lock(mutex_);
    const auto found = cache_.find(row.id);
    if (found != cache_.end()) found->second.known.credential.last_used_utc = used;
  }
  try {
    table_.note_use(row.id, used);
  } catch (const Error& failure) {
    log::warn(std::string("the use of a credential could not be noted: ") + failure.what());
  }
}

std::optional<Identity> Credentials::identify(const Secret& secret, CredentialKind kind) {
  const std::string id = id_inside(secret);
  if (id.empty()) return std::nullopt;
  const UtcMoment now = judged_time();
  const auto known = look_up(id);
  if (!known || known->credential.kind != to_text(kind) || !has_hash(secret, known->credential.hash))
    return std::nullopt;
  auto identity = identity_of(*known, now);
  if (identity) note_use(known->credential);
  return identity;
}

std::optional<Identity> Credentials::identify_again(const std::string& id) {
  const UtcMoment now = judged_time();
  const auto known = look_up(id);
  if (!known) return std::nullopt;
  auto identity = identity_of(*known, now);
  if (identity) note_use(known->credential);
  return identity;
}

IssuedCredential Credentials::issue(CredentialKind kind, const NewCredential& request) {
  const UtcMoment now = judged_time();
  const seconds lifetime = kind == CredentialKind::token    ? lifetimes_.token
                           : kind == CredentialKind::cookie ? lifetimes_.cookie
                                                            : lifetimes_.link;
  const UtcMoment ends = request.expires_utc.empty() ? now + lifetime : utc_moment(request.expires_utc);
  if (ends <= now || ends > now + lifetimes_.max)
    throw Error(
        ErrorKind::invalid_input,
        "it must end in the future, within " +
            std::to_string(std::chrono::duration_cast<std::chrono::hours>(lifetimes_.max).count() / 24) +
            " days");
  CredentialSecret secret = make_credential_secret();
  IssuedCredential issued;
  issued.row = {secret.id,
                to_text(kind),
                secret.hash,
                request.user_id,
                role_column(kind, request),
                request.name,
                request.only_session,
                request.parent_id,
                utc_text(now),
                utc_text(ends),
                kind == CredentialKind::cookie ? utc_text(now) : std::string()};
  issued.secret = std::move(secret.text);
  table_.remove_expired(utc_text(now - retention));
  table_.add(issued.row);
  return issued;
}

std::vector<store::CredentialRow> Credentials::list(CredentialKind kind, const std::string& user_id) const {
  auto rows = table_.list(to_text(kind), user_id);
  const std::string now = utc_text(now_());
  std::erase_if(rows, [&](const store::CredentialRow& row) { return row.expires_utc <= now; });
  return rows;
}

std::optional<store::CredentialRow> Credentials::find(const std::string& id, CredentialKind kind) const {
  auto known = table_.find(id);
  if (!known || known->credential.kind != to_text(kind)) return std::nullopt;
  return std::move(known->credential);
}

void Credentials::invalidate(const std::vector<std::string>& ids) {
  {
    const std::lock_guard lock(mutex_);
    ++invalidations_;
    for (const std::string& id : ids) cache_.erase(id);
  }
  if (on_change_ && !ids.empty()) on_change_(ids);
}

void Credentials::revoke(const std::string& id) { invalidate(table_.remove(id)); }

void Credentials::end_old_logins(const std::string& user_id, const std::string& except, bool keep_tokens) {
  const std::string kind = keep_tokens ? to_text(CredentialKind::cookie) : "";
  invalidate(table_.remove_of_user(user_id, kind, except));
}

void Credentials::revoke_links(const std::string& user_id) {
  invalidate(table_.remove_of_user(user_id, to_text(CredentialKind::link), ""));
}

void Credentials::revoke_all(const std::string& user_id) {
  invalidate(table_.remove_of_user(user_id, "", ""));
}

void Credentials::end_open_beginning(std::vector<std::string> ids) {
  ids.emplace_back();
  invalidate(ids);
}

void Credentials::renew(const std::string& user_id) {
  std::vector<std::string> ids;
  for (const CredentialKind kind : {CredentialKind::token, CredentialKind::cookie, CredentialKind::link})
    for (const store::CredentialRow& row : table_.list(to_text(kind), user_id)) ids.push_back(row.id);
  invalidate(ids);
}

}  // namespace ream::access
