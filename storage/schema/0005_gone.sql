-- What sensors have looked through of an object's surface since it was observed, by block, and what follows of it.

CREATE TABLE gone_blocks (
  block_key INTEGER PRIMARY KEY,
  submap_key INTEGER NOT NULL REFERENCES submaps ON DELETE CASCADE,
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  blob BLOB NOT NULL,
  UNIQUE (submap_key, x, y, z)
) STRICT;

ALTER TABLE submaps ADD COLUMN num_gone_blocks INTEGER NOT NULL DEFAULT 0;
ALTER TABLE submaps ADD COLUMN presence INTEGER NOT NULL DEFAULT 0;
ALTER TABLE submaps ADD COLUMN last_contradicted_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE submaps ADD COLUMN is_placed INTEGER NOT NULL DEFAULT 0;
