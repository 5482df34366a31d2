-- How far the observed voxels of a tile reach, so that the sphere around an object is known without reading its blobs. 0
-- where it is not known: of rows that an older version wrote, and of all layers but the TSDF. And the rows of objects that
-- do not say which blocks they have, so that a map opens without a look at all of its rows: only rows that schema 10 and
-- before wrote are among them, until their map is opened for paging.

ALTER TABLE tiles ADD COLUMN extent INTEGER NOT NULL DEFAULT 0;
CREATE INDEX tiles_without_cells ON tiles (owner_key) WHERE cells = 0 AND owner_key > 0;
