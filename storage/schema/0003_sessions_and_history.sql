-- How far clients' named sessions of frames have got in a map: written in the transaction of the frames.

CREATE TABLE feed_sessions (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  session TEXT NOT NULL,
  sequence INTEGER NOT NULL,
  time_ns INTEGER NOT NULL,
  PRIMARY KEY (map_key, session)
) STRICT, WITHOUT ROWID;

ALTER TABLE maps ADD COLUMN sessions_checksum INTEGER NOT NULL DEFAULT 0;

-- Which history a map's ids and revisions are of: see FORMAT.md, "Histories". Maps of before get one each.
ALTER TABLE maps ADD COLUMN history_id INTEGER NOT NULL DEFAULT 0;
UPDATE maps SET history_id = (random() & 9223372036854775806) + 1;

-- A row says that this file is a backup, and of when: whoever first opens it for writing gives its maps new histories.
CREATE TABLE backups (
  time_ns INTEGER NOT NULL
) STRICT;
