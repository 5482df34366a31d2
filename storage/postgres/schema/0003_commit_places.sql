-- For servers that follow a map: which rows of submaps and tiles each commit wrote or erased (storage/postgres/
-- commit_places.h). Those of the last 1,024 commits, and some more.
CREATE TABLE commit_places (
  map_key bigint NOT NULL,
  commit_id bigint NOT NULL,
  places bytea NOT NULL,
  PRIMARY KEY (map_key, commit_id)
);
