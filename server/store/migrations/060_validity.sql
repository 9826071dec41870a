-- Arms of studies, who rates their sessions, and the ratings.
ALTER TABLE study_participants ADD COLUMN arm TEXT NOT NULL DEFAULT '';
-- Places of the random sequence that are taken. They stay taken when a participant withdraws.
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
