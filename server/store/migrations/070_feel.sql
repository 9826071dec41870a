-- What participants of studies of feel answered. Trials are counted from 1.
CREATE TABLE study_feel_answers (
  study TEXT NOT NULL REFERENCES studies (id),
  participant TEXT NOT NULL,
  trial BIGINT NOT NULL,
  chosen TEXT NOT NULL,
  session TEXT NOT NULL,
  answered_utc TEXT NOT NULL,
  PRIMARY KEY (study, participant, trial)
);
