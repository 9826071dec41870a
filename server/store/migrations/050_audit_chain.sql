-- Every row of the audit log covers the one before it, see store/audit_table.hpp.
ALTER TABLE audit ADD COLUMN nonce TEXT NOT NULL DEFAULT '';
ALTER TABLE audit ADD COLUMN seal TEXT NOT NULL DEFAULT '';
ALTER TABLE audit ADD COLUMN chain TEXT NOT NULL DEFAULT '';
CREATE TABLE audit_head (
  id BIGINT PRIMARY KEY,
  number BIGINT NOT NULL,
  chain TEXT NOT NULL
);
-- The latest time that credentials were judged by.
CREATE TABLE credential_clock (
  id BIGINT PRIMARY KEY,
  latest_utc TEXT NOT NULL
);
-- What nobody in particular has made while there were no users. Who watches by a link logs in by it again.
DELETE FROM credentials WHERE user_id = '';
