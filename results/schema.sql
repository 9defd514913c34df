-- The outcomes of a study's finished trials. A row that is missing is work to do.

CREATE TABLE study (               -- one row: whose outcomes these are
  digest     TEXT    NOT NULL,     -- of all that decides an outcome, so not of the number of trials
  name       TEXT    NOT NULL,
  seed       INTEGER NOT NULL,
  source     TEXT    NOT NULL,     -- the study file's JSON
  folder     TEXT    NOT NULL,     -- where recordings that it names are looked for
  columns    TEXT    NOT NULL,     -- JSON list: the numbers of one outcome
  checksum   INTEGER NOT NULL      -- of all the above, and of id, name, methods and trials of every cell
);

CREATE TABLE cell (
  id         INTEGER PRIMARY KEY,  -- its place in the study
  name       TEXT    NOT NULL UNIQUE,
  methods    TEXT    NOT NULL,     -- JSON list, in the order of the outcomes
  trials     INTEGER NOT NULL,     -- asked for last
  finished   INTEGER NOT NULL DEFAULT 0,   -- rows of trials
  failures   INTEGER NOT NULL DEFAULT 0    -- rows of failures
);

CREATE TABLE session (             -- one row a run: which build on which machine made the outcomes
  id         INTEGER PRIMARY KEY,
  digest     TEXT    NOT NULL,     -- of the study as it was then
  version    TEXT    NOT NULL,     -- with compiler and flags the build: equal builds, equal bits
  compiler   TEXT    NOT NULL,
  flags      TEXT    NOT NULL,
  machine    TEXT    NOT NULL,
  process    INTEGER NOT NULL,
  started    TEXT    NOT NULL,     -- UTC
  trials     INTEGER NOT NULL DEFAULT 0,    -- that it finished
  progress   TEXT    NOT NULL DEFAULT '{}', -- JSON, as of the last batch
  checksum   INTEGER NOT NULL      -- of digest to started
);

CREATE TABLE trial (
  id         INTEGER PRIMARY KEY,  -- cell * 2^32 + trial
  session    INTEGER NOT NULL,
  calibrated INTEGER NOT NULL,     -- 0: the trial's own calibration did not converge
  outcomes   BLOB    NOT NULL,     -- little-endian doubles, columns within methods; NaN: no value
  checksum   INTEGER NOT NULL      -- of all the above but the session, and of its failures
);

CREATE TABLE failure (             -- trials in quarantine: a method threw or broke down
  id         INTEGER NOT NULL,     -- of the trial
  method     INTEGER NOT NULL,     -- its place in the cell
  reason     TEXT    NOT NULL,
  PRIMARY KEY (id, method)
) WITHOUT ROWID;

CREATE TRIGGER trial_finished AFTER INSERT ON trial BEGIN
  UPDATE cell SET finished = finished + 1 WHERE id = NEW.id >> 32;
  UPDATE session SET trials = trials + 1 WHERE id = NEW.session;
END;

CREATE TRIGGER failure_kept AFTER INSERT ON failure BEGIN
  UPDATE cell SET failures = failures + 1 WHERE id = NEW.id >> 32;
END;
