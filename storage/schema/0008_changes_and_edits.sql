-- What commits changed, for those who follow a map: one row a commit, written in its transaction, and one row a map that says
-- how far they go back. And when somebody last edited an object.

CREATE TABLE changes (
  change_key INTEGER PRIMARY KEY,
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  last_revision INTEGER NOT NULL,
  first_revision INTEGER NOT NULL,
  previous_revision INTEGER NOT NULL,
  time_ns INTEGER NOT NULL,
  blob BLOB NOT NULL,
  checksum_version INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  UNIQUE (map_key, last_revision)
) STRICT;

CREATE TABLE change_logs (
  map_key INTEGER PRIMARY KEY REFERENCES maps ON DELETE CASCADE,
  history_id INTEGER NOT NULL,
  complete_after INTEGER NOT NULL,
  last_revision INTEGER NOT NULL,
  num_changes INTEGER NOT NULL,
  num_bytes INTEGER NOT NULL,
  checksum_version INTEGER NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;

ALTER TABLE submaps ADD COLUMN edited_revision INTEGER NOT NULL DEFAULT 0;
