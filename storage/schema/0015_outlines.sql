-- How an object stands, so that lists tell boxes of what is left on the disk. Empty where it is not known: of rows that an
-- older version wrote, and of what is still being mapped.

ALTER TABLE submaps ADD COLUMN outline BLOB NOT NULL DEFAULT x'';
