-- What sessions are worth, to sort and filter by. Points of -1: none are known.
ALTER TABLE sessions ADD COLUMN points DOUBLE PRECISION NOT NULL DEFAULT -1;
ALTER TABLE sessions ADD COLUMN outcome TEXT NOT NULL DEFAULT '';
CREATE INDEX sessions_by_points ON sessions (points, id);
