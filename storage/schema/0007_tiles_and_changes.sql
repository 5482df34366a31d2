-- Layers of tiles (4 x 4 x 4 blocks) as blobs that are never written again, and who refers to them. A layer of objects or
-- of a map is a number, not a table. What was a row for each block is brought here by schema/bundle_blocks.cc, and its
-- tables go. Then what commits changed, for those who follow a map:
-- one row a commit, written in its transaction, and one row a map that says how far they go back; and when somebody last
-- edited an object.

CREATE TABLE tile_blobs (
  blob_key INTEGER PRIMARY KEY AUTOINCREMENT,
  num_blocks INTEGER NOT NULL,
  blob BLOB NOT NULL
) STRICT;

-- owner_key: submap_key of an object, or -map_key for what belongs to the map.
CREATE TABLE tiles (
  owner_key INTEGER NOT NULL,
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  layer INTEGER NOT NULL,
  blob_key INTEGER NOT NULL,
  PRIMARY KEY (owner_key, x, y, z, layer)
) STRICT, WITHOUT ROWID;

-- Blobs that more than one refers to, and how many beside the first.
CREATE TABLE shared_blobs (
  blob_key INTEGER PRIMARY KEY,
  num_more INTEGER NOT NULL
) STRICT;

-- Blobs that nobody refers to any more, to be deleted beside commits.
CREATE TABLE dead_blobs (
  blob_key INTEGER PRIMARY KEY
) STRICT;

CREATE TRIGGER tiles_delete AFTER DELETE ON tiles BEGIN
  INSERT OR IGNORE INTO dead_blobs
    SELECT OLD.blob_key WHERE NOT EXISTS (SELECT 1 FROM shared_blobs WHERE blob_key = OLD.blob_key);
  DELETE FROM shared_blobs WHERE blob_key = OLD.blob_key AND num_more = 1;
  UPDATE shared_blobs SET num_more = num_more - 1 WHERE blob_key = OLD.blob_key;
END;

CREATE TRIGGER tiles_update AFTER UPDATE OF blob_key ON tiles BEGIN
  INSERT OR IGNORE INTO dead_blobs
    SELECT OLD.blob_key WHERE NOT EXISTS (SELECT 1 FROM shared_blobs WHERE blob_key = OLD.blob_key);
  DELETE FROM shared_blobs WHERE blob_key = OLD.blob_key AND num_more = 1;
  UPDATE shared_blobs SET num_more = num_more - 1 WHERE blob_key = OLD.blob_key;
END;

CREATE TRIGGER submaps_delete_tiles AFTER DELETE ON submaps BEGIN
  DELETE FROM tiles WHERE owner_key = OLD.submap_key;
END;

CREATE TRIGGER maps_delete_tiles AFTER DELETE ON maps BEGIN
  DELETE FROM tiles WHERE owner_key = -OLD.map_key;
END;

ALTER TABLE submaps ADD COLUMN tiles_sum INTEGER NOT NULL DEFAULT 0;
ALTER TABLE maps ADD COLUMN tiles_sum INTEGER NOT NULL DEFAULT 0;

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
