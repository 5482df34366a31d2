-- Which submaps became parts of others, and what is known of whether two submaps are one object.

CREATE TABLE merged_ids (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  merged_id INTEGER NOT NULL,
  into_id INTEGER NOT NULL,
  PRIMARY KEY (map_key, merged_id)
) STRICT, WITHOUT ROWID;

CREATE TABLE object_pairs (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  first_id INTEGER NOT NULL,
  second_id INTEGER NOT NULL,
  verdict INTEGER NOT NULL,
  evidence INTEGER NOT NULL,
  PRIMARY KEY (map_key, first_id, second_id)
) STRICT, WITHOUT ROWID;

ALTER TABLE maps ADD COLUMN merged_checksum INTEGER NOT NULL DEFAULT 0;
ALTER TABLE maps ADD COLUMN pairs_checksum INTEGER NOT NULL DEFAULT 0;
