-- A row says which version of the checksum it carries, so that columns can be added: an old row goes on being checked by
-- what it covered. A map's config and classes have checksums of their own, of what is stored in them.

ALTER TABLE maps ADD COLUMN checksum_version INTEGER NOT NULL DEFAULT 1;
ALTER TABLE maps ADD COLUMN config_checksum INTEGER NOT NULL DEFAULT 0;
ALTER TABLE maps ADD COLUMN classes_checksum INTEGER NOT NULL DEFAULT 0;
ALTER TABLE submaps ADD COLUMN checksum_version INTEGER NOT NULL DEFAULT 1;

-- Numbers that somebody may have seen although the state that bears them is not stored: see FORMAT.md, "Numbers".
ALTER TABLE maps ADD COLUMN revision_mark INTEGER NOT NULL DEFAULT 0;
ALTER TABLE maps ADD COLUMN submap_id_mark INTEGER NOT NULL DEFAULT 0;

CREATE TABLE lost_revisions (
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  first_revision INTEGER NOT NULL,
  last_revision INTEGER NOT NULL,
  PRIMARY KEY (map_key, first_revision)
) STRICT, WITHOUT ROWID;
