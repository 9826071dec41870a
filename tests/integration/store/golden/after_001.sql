-- A database as ream left it after step 001, with a row of each table.
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
CREATE TABLE migrations (number BIGINT PRIMARY KEY, name TEXT NOT NULL);
INSERT INTO migrations (number, name) VALUES (1, '001_sessions.sql');
INSERT INTO sessions (id, case_id, script, state, created_utc, duration_s, trainee_id, trainee, study, participant, title, search, stamp, lasting) VALUES ('abcd2345', 'demo', 'demo', 'finished', '2025-03-01T12:00:00Z', 61.5, 'u1', 'Anna', '', '', 'First', 'anna first', 7, 1);
INSERT INTO session_records (id, record) VALUES ('abcd2345', '{}');
