-- What each session of frames knows of a thing: the id of its front end, and whether it has the thing in sight.

ALTER TABLE submaps ADD COLUMN sightings BLOB NOT NULL DEFAULT x'';
