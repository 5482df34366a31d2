-- What each server says about itself with its beat: the newest step that its version knows (a server writes it before this
-- step, too: storage/postgres/fleet/upgrade.h), and how its copies of other servers' maps follow. Additive: servers of
-- schema 4 go on beside it.
ALTER TABLE servers ADD COLUMN IF NOT EXISTS knows_schema bigint NOT NULL DEFAULT 4;
ALTER TABLE servers ADD COLUMN num_copies bigint NOT NULL DEFAULT 0;
ALTER TABLE servers ADD COLUMN behind_ns bigint NOT NULL DEFAULT 0;
