-- DHP Map Server on PostgreSQL, schema 1. Never edited once released: changes go into 0002_*.sql. What the columns mean:
-- storage/FORMAT.md. map_key is in every key, so that a map's rows can lie together on one of many nodes; and there are no
-- triggers, sequences, cascades, LISTEN or advisory locks, which such systems lack or limit.

CREATE TABLE map_names (
  name text COLLATE "C" PRIMARY KEY,
  map_key bigint NOT NULL
);

-- commit_id counts commits of any kind, owner_epoch changes of the owner: both are in each commit's condition. Half of each
-- page stays free, so that updates stay on it.
CREATE TABLE maps (
  map_key bigint PRIMARY KEY,
  commit_id bigint NOT NULL,
  owner bigint NOT NULL,
  owner_epoch bigint NOT NULL,
  next_blob_key bigint NOT NULL,
  seen_ns bigint NOT NULL,
  checksum_version integer NOT NULL,
  checksum bigint NOT NULL,
  name text COLLATE "C" NOT NULL,
  display_name text NOT NULL,
  revision bigint NOT NULL,
  num_frames bigint NOT NULL,
  next_submap_id bigint NOT NULL,
  create_time_ns bigint NOT NULL,
  update_time_ns bigint NOT NULL,
  num_submaps bigint NOT NULL,
  config_checksum bigint NOT NULL,
  classes_checksum bigint NOT NULL,
  revision_mark bigint NOT NULL,
  submap_id_mark bigint NOT NULL,
  sessions_checksum bigint NOT NULL,
  history_id bigint NOT NULL,
  num_tiles bigint NOT NULL,
  tile_bytes bigint NOT NULL,
  merged_checksum bigint NOT NULL,
  pairs_checksum bigint NOT NULL,
  tiles_sum bigint NOT NULL,
  kept_clear_checksum bigint NOT NULL,
  leaving_submap_id bigint NOT NULL
) WITH (fillfactor = 50);

-- Maps that have lost their name and row: what else they have is deleted step by step.
CREATE TABLE removed_maps (
  map_key bigint PRIMARY KEY
);

CREATE TABLE lost_revisions (
  map_key bigint NOT NULL,
  first_revision bigint NOT NULL,
  last_revision bigint NOT NULL,
  PRIMARY KEY (map_key, first_revision)
);

CREATE TABLE map_config (
  map_key bigint NOT NULL,
  key text COLLATE "C" NOT NULL,
  value text NOT NULL,
  PRIMARY KEY (map_key, key)
);

CREATE TABLE label_classes (
  map_key bigint NOT NULL,
  class_id bigint NOT NULL,
  name text NOT NULL,
  panoptic bigint NOT NULL,
  size bigint NOT NULL,
  color_rgb bigint NOT NULL,
  PRIMARY KEY (map_key, class_id)
);

CREATE TABLE feed_sessions (
  map_key bigint NOT NULL,
  session text COLLATE "C" NOT NULL,
  sequence bigint NOT NULL,
  time_ns bigint NOT NULL,
  PRIMARY KEY (map_key, session)
);

CREATE TABLE merged_ids (
  map_key bigint NOT NULL,
  merged_id bigint NOT NULL,
  into_id bigint NOT NULL,
  PRIMARY KEY (map_key, merged_id)
);

CREATE TABLE object_pairs (
  map_key bigint NOT NULL,
  first_id bigint NOT NULL,
  second_id bigint NOT NULL,
  verdict bigint NOT NULL,
  evidence bigint NOT NULL,
  PRIMARY KEY (map_key, first_id, second_id)
);

CREATE TABLE kept_clear (
  map_key bigint NOT NULL,
  name text COLLATE "C" NOT NULL,
  region bytea NOT NULL,
  PRIMARY KEY (map_key, name)
);

CREATE TABLE submaps (
  map_key bigint NOT NULL,
  submap_id bigint NOT NULL,
  blob_bytes bigint NOT NULL,
  checksum_version integer NOT NULL,
  checksum bigint NOT NULL,
  panoptic bigint NOT NULL,
  class_id bigint NOT NULL,
  class_is_fixed bigint NOT NULL,
  display_name text NOT NULL,
  pose bytea NOT NULL,
  sphere bytea NOT NULL,
  voxel_size_m double precision NOT NULL,
  truncation_m double precision NOT NULL,
  class_counts bytea NOT NULL,
  instance_confidence double precision NOT NULL,
  activity bigint NOT NULL,
  is_confirmed bigint NOT NULL,
  num_frames_observed bigint NOT NULL,
  num_frames_missed bigint NOT NULL,
  num_frames_overlooked bigint NOT NULL,
  first_observed_ns bigint NOT NULL,
  last_observed_ns bigint NOT NULL,
  track_id bigint NOT NULL,
  revision bigint NOT NULL,
  num_tsdf_blocks bigint NOT NULL,
  num_label_blocks bigint NOT NULL,
  num_gone_blocks bigint NOT NULL,
  presence bigint NOT NULL,
  last_contradicted_ns bigint NOT NULL,
  is_placed bigint NOT NULL,
  tiles_sum bigint NOT NULL,
  edited_revision bigint NOT NULL,
  sightings bytea NOT NULL,
  is_locked bigint NOT NULL,
  outline bytea NOT NULL,
  PRIMARY KEY (map_key, submap_id)
) WITH (fillfactor = 70);

-- owner_id: of a submap, or -1 for what belongs to the map. num_bytes: of the blob.
CREATE TABLE tiles (
  map_key bigint NOT NULL,
  owner_id bigint NOT NULL,
  x integer NOT NULL,
  y integer NOT NULL,
  z integer NOT NULL,
  layer smallint NOT NULL,
  num_bytes integer NOT NULL,
  blob_key bigint NOT NULL,
  cells bigint NOT NULL,
  extent bigint NOT NULL,
  PRIMARY KEY (map_key, owner_id, x, y, z, layer)
);

-- Never updated. Blobs are compressed already; those below 8 kB stay in their row.
CREATE TABLE tile_blobs (
  map_key bigint NOT NULL,
  blob_key bigint NOT NULL,
  num_blocks integer NOT NULL,
  blob bytea NOT NULL,
  PRIMARY KEY (map_key, blob_key)
) WITH (toast_tuple_target = 8160);
ALTER TABLE tile_blobs ALTER blob SET STORAGE EXTERNAL;

-- How many refer to a blob, where that is, or was, not one. Nobody: since when, to be deleted after a grace.
CREATE TABLE blob_counts (
  map_key bigint NOT NULL,
  blob_key bigint NOT NULL,
  num_refs bigint NOT NULL,
  since_ns bigint NOT NULL,
  PRIMARY KEY (map_key, blob_key)
);
CREATE INDEX dead_blobs ON blob_counts (map_key, since_ns) WHERE num_refs <= 0;

CREATE TABLE changes (
  map_key bigint NOT NULL,
  last_revision bigint NOT NULL,
  first_revision bigint NOT NULL,
  previous_revision bigint NOT NULL,
  time_ns bigint NOT NULL,
  seen_ns bigint NOT NULL,
  checksum_version integer NOT NULL,
  checksum bigint NOT NULL,
  blob bytea NOT NULL,
  PRIMARY KEY (map_key, last_revision)
);

CREATE TABLE change_logs (
  map_key bigint PRIMARY KEY,
  history_id bigint NOT NULL,
  complete_after bigint NOT NULL,
  last_revision bigint NOT NULL,
  num_changes bigint NOT NULL,
  num_bytes bigint NOT NULL,
  checksum_version integer NOT NULL,
  checksum bigint NOT NULL
) WITH (fillfactor = 50);

CREATE TABLE edits (
  map_key bigint NOT NULL,
  revision bigint NOT NULL,
  time_ns bigint NOT NULL,
  seen_ns bigint NOT NULL,
  kind bigint NOT NULL,
  author text COLLATE "C" NOT NULL,
  request_id text COLLATE "C" NOT NULL,
  request_fingerprint bigint NOT NULL,
  summary bytea NOT NULL,
  answer bytea NOT NULL,
  checksum_version integer NOT NULL,
  checksum bigint NOT NULL,
  PRIMARY KEY (map_key, revision)
);
CREATE INDEX edits_by_request ON edits (map_key, request_id) WHERE request_id <> '';
CREATE INDEX edits_by_author ON edits (map_key, author, revision);

-- How much is kept of each map.
CREATE TABLE edit_totals (
  map_key bigint PRIMARY KEY,
  num_edits bigint NOT NULL,
  edit_bytes bigint NOT NULL,
  num_histories bigint NOT NULL,
  history_bytes bigint NOT NULL
);

CREATE TABLE edit_targets (
  map_key bigint NOT NULL,
  target bigint NOT NULL,
  revision bigint NOT NULL,
  kind bigint NOT NULL,
  PRIMARY KEY (map_key, target, revision)
);

-- edit_key: the revision of the edit.
CREATE TABLE edit_histories (
  map_key bigint NOT NULL,
  edit_key bigint NOT NULL,
  revision bigint NOT NULL,
  time_ns bigint NOT NULL,
  num_bytes bigint NOT NULL,
  tiles_sum bigint NOT NULL,
  checksum_version integer NOT NULL,
  checksum bigint NOT NULL,
  blob bytea NOT NULL,
  PRIMARY KEY (map_key, edit_key)
);

-- submap_id: as tiles.owner_id. A key of 0: there was, or is, none.
CREATE TABLE edit_tiles (
  map_key bigint NOT NULL,
  edit_key bigint NOT NULL,
  submap_id bigint NOT NULL,
  x integer NOT NULL,
  y integer NOT NULL,
  z integer NOT NULL,
  layer smallint NOT NULL,
  before_key bigint NOT NULL,
  after_key bigint NOT NULL,
  PRIMARY KEY (map_key, edit_key, submap_id, x, y, z, layer)
);
