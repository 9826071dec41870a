-- A database as ream left it after step 060, with a row of each table.
-- What a list of sessions is answered from. Folders are the truth: all of it can be made again from them.
CREATE TABLE sessions (
  id TEXT PRIMARY KEY,
  case_id TEXT NOT NULL,
  script TEXT NOT NULL,
  state TEXT NOT NULL,
  created_utc TEXT NOT NULL,
  duration_s DOUBLE PRECISION NOT NULL,
  trainee_id TEXT NOT NULL,
  trainee TEXT NOT NULL,
  study TEXT NOT NULL,
  participant TEXT NOT NULL,
  title TEXT NOT NULL,
  search TEXT NOT NULL,
  stamp BIGINT NOT NULL,
  lasting BIGINT NOT NULL
);
CREATE INDEX sessions_by_created ON sessions (created_utc, id);
CREATE INDEX sessions_by_duration ON sessions (duration_s, id);
CREATE INDEX sessions_by_case ON sessions (case_id, created_utc, id);
CREATE INDEX sessions_by_trainee ON sessions (trainee_id, created_utc, id);
CREATE INDEX sessions_by_study ON sessions (study, participant, created_utc, id);
CREATE INDEX sessions_by_state ON sessions (state, created_utc, id);

-- Apart, so that looking through all sessions stays quick.
CREATE TABLE session_records (
  id TEXT PRIMARY KEY REFERENCES sessions (id) ON DELETE CASCADE,
  record TEXT NOT NULL
);
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
-- What was answered to requests that may be repeated.
CREATE TABLE kept_answers (
  caller TEXT NOT NULL,
  key TEXT NOT NULL,
  request TEXT NOT NULL,
  status BIGINT NOT NULL,
  content_type TEXT NOT NULL,
  location TEXT NOT NULL,
  body TEXT NOT NULL,
  at_ms BIGINT NOT NULL,
  PRIMARY KEY (caller, key)
);
CREATE INDEX kept_answers_by_time ON kept_answers (at_ms);
-- Studies, who takes part under which code, and, apart from that, who the persons are.
CREATE TABLE studies (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  description TEXT NOT NULL,
  state TEXT NOT NULL,
  join_code TEXT NOT NULL UNIQUE,
  settings TEXT NOT NULL,
  questionnaire TEXT NOT NULL,
  created_utc TEXT NOT NULL,
  closed_utc TEXT NOT NULL,
  unblinded_utc TEXT NOT NULL
);
CREATE TABLE study_participants (
  code TEXT PRIMARY KEY,
  study TEXT NOT NULL REFERENCES studies (id),
  experience TEXT NOT NULL,
  procedures_done BIGINT NOT NULL,
  answers TEXT NOT NULL
);
CREATE INDEX study_participants_by_study ON study_participants (study);
CREATE TABLE study_persons (
  code TEXT PRIMARY KEY REFERENCES study_participants (code),
  study TEXT NOT NULL,
  user_id TEXT NOT NULL,
  name TEXT NOT NULL
);
CREATE UNIQUE INDEX study_persons_once ON study_persons (study, user_id) WHERE user_id <> '';
CREATE INDEX study_persons_by_user ON study_persons (user_id);
-- What sessions are worth, to sort and filter by. Points of -1: none are known.
ALTER TABLE sessions ADD COLUMN points DOUBLE PRECISION NOT NULL DEFAULT -1;
ALTER TABLE sessions ADD COLUMN outcome TEXT NOT NULL DEFAULT '';
CREATE INDEX sessions_by_points ON sessions (points, id);
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
CREATE TABLE migrations (number BIGINT PRIMARY KEY, name TEXT NOT NULL);
ALTER TABLE study_participants ADD COLUMN arm TEXT NOT NULL DEFAULT '';
CREATE TABLE study_allocations (
  study TEXT NOT NULL REFERENCES studies (id),
  stratum TEXT NOT NULL,
  place BIGINT NOT NULL,
  PRIMARY KEY (study, stratum, place)
);
CREATE TABLE study_raters (
  study TEXT NOT NULL REFERENCES studies (id),
  label TEXT NOT NULL,
  user_id TEXT NOT NULL,
  name TEXT NOT NULL,
  PRIMARY KEY (study, label)
);
CREATE UNIQUE INDEX study_raters_once ON study_raters (study, user_id) WHERE user_id <> '';
CREATE INDEX study_raters_by_user ON study_raters (user_id);
CREATE TABLE study_ratings (
  study TEXT NOT NULL REFERENCES studies (id),
  rater TEXT NOT NULL,
  session TEXT NOT NULL,
  answers TEXT NOT NULL,
  PRIMARY KEY (study, rater, session)
);
CREATE TABLE study_feel_answers (
  study TEXT NOT NULL REFERENCES studies (id),
  participant TEXT NOT NULL,
  trial BIGINT NOT NULL,
  chosen TEXT NOT NULL,
  session TEXT NOT NULL,
  answered_utc TEXT NOT NULL,
  PRIMARY KEY (study, participant, trial)
);
INSERT INTO migrations (number, name) VALUES (1, '001_sessions.sql');
INSERT INTO migrations (number, name) VALUES (10, '010_access.sql');
INSERT INTO migrations (number, name) VALUES (20, '020_idempotency.sql');
INSERT INTO migrations (number, name) VALUES (30, '030_studies.sql');
INSERT INTO migrations (number, name) VALUES (40, '040_marks.sql');
INSERT INTO migrations (number, name) VALUES (50, '050_audit_chain.sql');
INSERT INTO migrations (number, name) VALUES (60, '060_validity.sql');
INSERT INTO migrations (number, name) VALUES (70, '070_feel.sql');
INSERT INTO sessions (id, case_id, script, state, created_utc, duration_s, trainee_id, trainee, study, participant, title, search, stamp, lasting) VALUES ('abcd2345', 'demo', 'demo', 'finished', '2025-03-01T12:00:00Z', 61.5, 'u1', 'Anna', '', '', 'First', 'anna first', 7, 1);
INSERT INTO session_records (id, record) VALUES ('abcd2345', '{}');
INSERT INTO users (id, name, display_name, role, enabled, created_utc, password_hash) VALUES ('u1', 'anna', 'Anna', 'operator', 1, '2025-03-01T12:00:00Z', 'hash');
INSERT INTO credentials (id, kind, hash, user_id, role, name, session_id, parent_id, created_utc, expires_utc, last_used_utc) VALUES ('t1', 'token', 'hash', 'u1', '', 'robot', '', '', '2025-03-01T12:00:00Z', '2095-03-01T12:00:00Z', '');
INSERT INTO credentials (id, kind, hash, user_id, role, name, session_id, parent_id, created_utc, expires_utc, last_used_utc) VALUES ('l1', 'link', 'hash', '', 'viewer', 'nobodys', '', '', '2025-03-01T12:00:00Z', '2095-03-01T12:00:00Z', '');
INSERT INTO login_failures (key, failures, last_ms) VALUES ('name:x', 3, 1740830400000);
INSERT INTO login_places (key, last_ms) VALUES ('name:x@place:y', 1740830400000);
INSERT INTO audit (at_utc, user_id, name, role, credential, address, action, object, detail) VALUES ('2025-03-01T12:00:00Z', 'u1', 'anna', 'operator', 't1', '10.0.0.1', 'user.add', 'u2', 'ben as trainee');
INSERT INTO kept_answers (caller, key, request, status, content_type, location, body, at_ms) VALUES ('u1', 'k1', 'print', 201, 'application/json', '/api/v1/sessions/abcd2345', '{}', 1740830400000);
INSERT INTO studies (id, name, description, state, join_code, settings, questionnaire, created_utc, closed_utc, unblinded_utc) VALUES ('st1', 'A study', '', 'open', 'join', '{}', '{}', '2025-03-01T12:00:00Z', '', '');
INSERT INTO study_participants (code, study, experience, procedures_done, answers) VALUES ('P01', 'st1', 'novice', 0, '{}');
INSERT INTO study_persons (code, study, user_id, name) VALUES ('P01', 'st1', 'u1', 'Anna');
UPDATE sessions SET points = 81.5, outcome = 'pass';
INSERT INTO credential_clock (id, latest_utc) VALUES (1, '2025-03-01T12:00:00Z');
UPDATE study_participants SET arm = 'control';
INSERT INTO study_allocations (study, stratum, place) VALUES ('st1', 'novice', 0);
INSERT INTO study_raters (study, label, user_id, name) VALUES ('st1', 'R1', 'u1', 'Anna');
INSERT INTO study_ratings (study, rater, session, answers) VALUES ('st1', 'R1', 'abcd2345', '{}');
INSERT INTO study_feel_answers (study, participant, trial, chosen, session, answered_utc) VALUES ('st1', 'P01', 1, 'upper', 'abcd2345', '2025-03-01T12:00:00Z');
