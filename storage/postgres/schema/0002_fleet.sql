-- The servers on this database. Each raises its beat several times a second or so; who does not is dead after a lease.
-- Half of each page stays free, so that beats stay on it.
CREATE TABLE servers (
  server bigint PRIMARY KEY,
  beat bigint NOT NULL,
  address text NOT NULL,
  version text NOT NULL,
  is_draining bigint NOT NULL
) WITH (fillfactor = 50);
