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
