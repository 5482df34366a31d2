-- Maps that are being imported: their rows are there, under keys that have no name yet. Whoever imports one holds a lock
-- on its row here: without one it was given up, and goes as a removed map does.
CREATE TABLE incoming_maps (
  map_key bigint PRIMARY KEY
);
