-- Which blocks of a tile have a layer, so that a map opens without reading its blobs: bit c for the block at cell c. 0
-- where it is not known: of rows that an older version wrote, until their map is opened for paging, and of layers of maps.

ALTER TABLE tiles ADD COLUMN cells INTEGER NOT NULL DEFAULT 0;
