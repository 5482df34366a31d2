-- Layers that belong to a map, not to one of its objects, by tiles of 4 x 4 x 4 blocks of the map's grid. Which layer a row is
-- of is in the blob's first byte, too: another layer is another number, not another table.

CREATE TABLE map_tiles (
  tile_key INTEGER PRIMARY KEY,
  map_key INTEGER NOT NULL REFERENCES maps ON DELETE CASCADE,
  layer INTEGER NOT NULL,
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  blob BLOB NOT NULL,
  UNIQUE (map_key, layer, x, y, z)
) STRICT;

ALTER TABLE maps ADD COLUMN num_tiles INTEGER NOT NULL DEFAULT 0;
ALTER TABLE maps ADD COLUMN tile_bytes INTEGER NOT NULL DEFAULT 0;
