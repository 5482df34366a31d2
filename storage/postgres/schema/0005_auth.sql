-- What all servers need to know of callers (storage/auth_tables.h). A version is raised by every change of its rows:
-- servers look at it, and read the rows only if it has changed.
CREATE TABLE auth_versions (
  name text COLLATE "C" PRIMARY KEY,
  version bigint NOT NULL
);
INSERT INTO auth_versions (name, version) VALUES ('keys', 0);

-- record: a line of JSON as in a file of keys. It has the key's SHA-256, never the key.
CREATE TABLE auth_keys (
  id text COLLATE "C" PRIMARY KEY,
  record text NOT NULL
);

-- server and number tell rows of one second apart; an empty principal: an unknown caller.
CREATE TABLE audit_rows (
  time_s bigint NOT NULL,
  server bigint NOT NULL,
  number bigint NOT NULL,
  principal text NOT NULL,
  key_id text NOT NULL,
  rpc text NOT NULL,
  map text NOT NULL,
  decision text NOT NULL,
  num_left_out bigint NOT NULL,
  PRIMARY KEY (time_s, server, number)
);

-- history_id: as maps.history_id.
CREATE TABLE map_makers (
  history_id bigint PRIMARY KEY,
  principal text COLLATE "C" NOT NULL
);
CREATE INDEX map_makers_by_principal ON map_makers (principal);
