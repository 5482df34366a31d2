-- What each session of frames knows of a thing: the id of its front end, and whether it has the thing in sight.

ALTER TABLE submaps ADD COLUMN sightings BLOB NOT NULL DEFAULT x'';

-- The edits of one author, the newest first, without reading those of all others.
CREATE INDEX edits_by_author ON edits (map_key, author, revision);
