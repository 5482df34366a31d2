-- How old what is kept of edits and changes is, by the time that servers have seen pass: the system's clock may be set at
-- any moment. Rows of before count as made when it began.

ALTER TABLE edits ADD COLUMN seen_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE changes ADD COLUMN seen_ns INTEGER NOT NULL DEFAULT 0;

-- One row: how far it has got.
CREATE TABLE seen_time (
  clock INTEGER PRIMARY KEY CHECK (clock = 1),
  seen_ns INTEGER NOT NULL,
  checksum_version INTEGER NOT NULL,
  checksum INTEGER NOT NULL
) STRICT;
