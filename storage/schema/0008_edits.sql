-- What somebody has edited, a row an edit: the log, and what a repeated request is answered. Then what it takes to undo
-- one, as long as that is kept: rows as they were and are, and which blobs the tiles were and are. These count as
-- referring to their blobs, so nothing that can be undone is deleted.

CREATE TABLE edits (
  edit_key INTEGER PRIMARY KEY,
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  time_ns INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  author TEXT NOT NULL,
  request_id TEXT NOT NULL,
  request_fingerprint INTEGER NOT NULL,
  summary BLOB NOT NULL,
  answer BLOB NOT NULL,
  checksum_version INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  UNIQUE (map_key, revision)
) STRICT;

CREATE INDEX edits_by_request ON edits (map_key, request_id) WHERE request_id <> '';

-- How much is kept of each map, kept in step by triggers.
CREATE TABLE edit_totals (
  map_key INTEGER PRIMARY KEY REFERENCES maps ON DELETE CASCADE,
  num_edits INTEGER NOT NULL DEFAULT 0,
  edit_bytes INTEGER NOT NULL DEFAULT 0,
  num_histories INTEGER NOT NULL DEFAULT 0,
  history_bytes INTEGER NOT NULL DEFAULT 0
) STRICT;

CREATE TRIGGER edits_insert_total AFTER INSERT ON edits BEGIN
  INSERT OR IGNORE INTO edit_totals (map_key) VALUES (NEW.map_key);
  UPDATE edit_totals SET num_edits = num_edits + 1, edit_bytes = edit_bytes + 64 + length(NEW.author)
    + length(NEW.request_id) + length(NEW.summary) + length(NEW.answer) WHERE map_key = NEW.map_key;
END;

CREATE TRIGGER edits_delete_total AFTER DELETE ON edits BEGIN
  UPDATE edit_totals SET num_edits = num_edits - 1, edit_bytes = edit_bytes - 64 - length(OLD.author)
    - length(OLD.request_id) - length(OLD.summary) - length(OLD.answer) WHERE map_key = OLD.map_key;
  DELETE FROM edit_targets WHERE map_key = OLD.map_key AND target = OLD.revision;
END;

-- What was undone, and done again: the last row of a target says how it is now. Kept as long as the target.
CREATE TABLE edit_targets (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  target INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  kind INTEGER NOT NULL,
  PRIMARY KEY (map_key, target, revision)
) STRICT, WITHOUT ROWID;

CREATE TABLE edit_histories (
  edit_key INTEGER PRIMARY KEY REFERENCES edits ON DELETE CASCADE,
  map_key INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  time_ns INTEGER NOT NULL,
  num_bytes INTEGER NOT NULL,
  tiles_sum INTEGER NOT NULL,
  blob BLOB NOT NULL,
  checksum_version INTEGER NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;

CREATE INDEX edit_histories_by_age ON edit_histories (map_key, revision);

-- submap_id: of the object, or -1 for what belongs to the map. A key of 0: there was, or is, none.
CREATE TABLE edit_tiles (
  edit_key INTEGER NOT NULL,
  submap_id INTEGER NOT NULL,
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  layer INTEGER NOT NULL,
  before_key INTEGER NOT NULL,
  after_key INTEGER NOT NULL,
  PRIMARY KEY (edit_key, submap_id, x, y, z, layer)
) STRICT, WITHOUT ROWID;

CREATE TRIGGER edit_histories_insert_total AFTER INSERT ON edit_histories BEGIN
  UPDATE edit_totals SET num_histories = num_histories + 1, history_bytes = history_bytes + NEW.num_bytes
    WHERE map_key = NEW.map_key;
END;

CREATE TRIGGER edit_histories_delete AFTER DELETE ON edit_histories BEGIN
  UPDATE edit_totals SET num_histories = num_histories - 1, history_bytes = history_bytes - OLD.num_bytes
    WHERE map_key = OLD.map_key;
  DELETE FROM edit_tiles WHERE edit_key = OLD.edit_key;
END;

CREATE TRIGGER edit_tiles_delete AFTER DELETE ON edit_tiles BEGIN
  INSERT OR IGNORE INTO dead_blobs SELECT OLD.before_key
    WHERE OLD.before_key <> 0 AND NOT EXISTS (SELECT 1 FROM shared_blobs WHERE blob_key = OLD.before_key);
  DELETE FROM shared_blobs WHERE blob_key = OLD.before_key AND num_more = 1;
  UPDATE shared_blobs SET num_more = num_more - 1 WHERE blob_key = OLD.before_key;
  INSERT OR IGNORE INTO dead_blobs SELECT OLD.after_key
    WHERE OLD.after_key <> 0 AND NOT EXISTS (SELECT 1 FROM shared_blobs WHERE blob_key = OLD.after_key);
  DELETE FROM shared_blobs WHERE blob_key = OLD.after_key AND num_more = 1;
  UPDATE shared_blobs SET num_more = num_more - 1 WHERE blob_key = OLD.after_key;
END;

CREATE VIEW blob_references AS
  SELECT blob_key FROM tiles
  UNION ALL SELECT before_key FROM edit_tiles WHERE before_key <> 0
  UNION ALL SELECT after_key FROM edit_tiles WHERE after_key <> 0;
