-- What an edit has moved and what it left is not among the map's tiles yet: the next commit writes it. -1: nothing.

ALTER TABLE maps ADD COLUMN leaving_submap_id INTEGER NOT NULL DEFAULT -1;
