-- Who may use the server. Passwords and secrets are kept as hashes only.
CREATE TABLE users (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  display_name TEXT NOT NULL,
  role TEXT NOT NULL,
  enabled BIGINT NOT NULL,
  created_utc TEXT NOT NULL,
  password_hash TEXT NOT NULL
);
-- Tokens, cookie sessions and viewer links. user_id is the owner, of links who made them; empty: nobody.
CREATE TABLE credentials (
  id TEXT PRIMARY KEY,
  kind TEXT NOT NULL,
  hash TEXT NOT NULL,
  user_id TEXT NOT NULL,
  role TEXT NOT NULL,
  name TEXT NOT NULL,
  session_id TEXT NOT NULL,
  parent_id TEXT NOT NULL,
  created_utc TEXT NOT NULL,
  expires_utc TEXT NOT NULL,
  last_used_utc TEXT NOT NULL
);
CREATE INDEX credentials_by_user ON credentials (user_id);
CREATE INDEX credentials_by_parent ON credentials (parent_id);
CREATE INDEX credentials_by_expiry ON credentials (expires_utc);
-- Keys are hashes of names and addresses.
CREATE TABLE login_failures (
  key TEXT PRIMARY KEY,
  failures BIGINT NOT NULL,
  last_ms BIGINT NOT NULL
);
CREATE INDEX login_failures_by_time ON login_failures (last_ms);
-- Where somebody has logged in before.
CREATE TABLE login_places (
  key TEXT PRIMARY KEY,
  last_ms BIGINT NOT NULL
);
CREATE INDEX login_places_by_time ON login_places (last_ms);
CREATE TABLE audit (
  number NUMBERED_KEY,
  at_utc TEXT NOT NULL,
  user_id TEXT NOT NULL,
  name TEXT NOT NULL,
  role TEXT NOT NULL,
  credential TEXT NOT NULL,
  address TEXT NOT NULL,
  action TEXT NOT NULL,
  object TEXT NOT NULL,
  detail TEXT NOT NULL
);
