-- Submaps that mapping leaves alone, and regions that it keeps clear.

ALTER TABLE submaps ADD COLUMN is_locked INTEGER NOT NULL DEFAULT 0;
ALTER TABLE maps ADD COLUMN kept_clear_checksum INTEGER NOT NULL DEFAULT 0;

CREATE TABLE kept_clear (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  name TEXT NOT NULL,
  region BLOB NOT NULL,
  PRIMARY KEY (map_key, name)
) STRICT, WITHOUT ROWID;
