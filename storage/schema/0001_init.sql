-- DHP Map Server database, schema 1. Never edited once released: changes go into 0002_*.sql. Meaning of every column and
-- blob: storage/FORMAT.md.

CREATE TABLE maps (
  map_key INTEGER PRIMARY KEY AUTOINCREMENT,
  name TEXT NOT NULL UNIQUE,
  display_name TEXT NOT NULL,
  revision INTEGER NOT NULL,
  num_frames INTEGER NOT NULL,
  next_submap_id INTEGER NOT NULL,
  create_time_ns INTEGER NOT NULL,
  update_time_ns INTEGER NOT NULL,
  num_submaps INTEGER NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;

CREATE TABLE map_config (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  key TEXT NOT NULL,
  value TEXT NOT NULL,
  PRIMARY KEY (map_key, key)
) STRICT, WITHOUT ROWID;

CREATE TABLE label_classes (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  class_id INTEGER NOT NULL,
  name TEXT NOT NULL,
  panoptic INTEGER NOT NULL,
  size INTEGER NOT NULL,
  color_rgb INTEGER NOT NULL,
  PRIMARY KEY (map_key, class_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE submaps (
  submap_key INTEGER PRIMARY KEY AUTOINCREMENT,
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  submap_id INTEGER NOT NULL,
  panoptic INTEGER NOT NULL,
  class_id INTEGER NOT NULL,
  class_is_fixed INTEGER NOT NULL,
  display_name TEXT NOT NULL,
  pose BLOB NOT NULL,
  sphere BLOB NOT NULL,
  voxel_size_m REAL NOT NULL,
  truncation_m REAL NOT NULL,
  class_counts BLOB NOT NULL,
  instance_confidence REAL NOT NULL,
  activity INTEGER NOT NULL,
  is_confirmed INTEGER NOT NULL,
  num_frames_observed INTEGER NOT NULL,
  num_frames_missed INTEGER NOT NULL,
  num_frames_overlooked INTEGER NOT NULL,
  first_observed_ns INTEGER NOT NULL,
  last_observed_ns INTEGER NOT NULL,
  track_id INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  num_tsdf_blocks INTEGER NOT NULL,
  num_label_blocks INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  blob_bytes INTEGER NOT NULL DEFAULT 0,
  UNIQUE (map_key, submap_id)
) STRICT;

-- Boxes of the bounding spheres, map frame. No row for a submap without blocks.
CREATE VIRTUAL TABLE submap_boxes USING rtree(
  submap_key, min_x_m, max_x_m, min_y_m, max_y_m, min_z_m, max_z_m, +map_key INTEGER
);

CREATE TRIGGER submaps_delete_box AFTER DELETE ON submaps BEGIN
  DELETE FROM submap_boxes WHERE submap_key = OLD.submap_key;
END;

-- Tables with a rowid, not keyed by index: blobs of up to 4 kB then stay inside a leaf page.
CREATE TABLE tsdf_blocks (
  block_key INTEGER PRIMARY KEY,
  submap_key INTEGER NOT NULL REFERENCES submaps ON DELETE CASCADE,
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  blob BLOB NOT NULL,
  UNIQUE (submap_key, x, y, z)
) STRICT;

CREATE TABLE label_blocks (
  block_key INTEGER PRIMARY KEY,
  submap_key INTEGER NOT NULL REFERENCES submaps ON DELETE CASCADE,
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  blob BLOB NOT NULL,
  UNIQUE (submap_key, x, y, z)
) STRICT;
