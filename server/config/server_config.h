// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/status.h"
#include "mapping/map/map_config.h"

namespace dhpmap {

/// All settings of the server. Precedence: these defaults < file < environment < flags.
struct ServerConfig {
  std::string db;  ///< the SQLite file with the maps; required to serve
  bool insecure = false;
  bool insecure_no_tls = false;
  bool insecure_no_auth = false;

  struct Grpc {
    std::string address = "127.0.0.1:50051";
    int max_message_mib = 64;
    int num_threads = 4;
    int bulk_threads = 0;
    int max_connections = 1000;
    double keepalive_s = 10;
  } grpc;
  struct Http {
    std::string address = "127.0.0.1:8080";
    int max_body_mib = 64;
    int num_threads = 1;
    std::string allowed_hosts;
    std::string allowed_origins;
    int max_connections = 1000;
    double idle_timeout_s = 60;
    double header_timeout_s = 10;
  } http;
  struct Auth {
    std::string keys;
    std::string audit;
    bool audit_required = false;
  } auth;
  struct Tls {
    std::string cert, key, client_ca;
    std::string client_auth = "none";

    [[nodiscard]] bool is_on() const { return !cert.empty(); }
  } tls;
  struct Log {
    std::string level = "info";
    bool json = false;
  } log;
  struct Mapping {
    int num_threads = 0;
    int publish_frames = 10;
    double publish_s = 0.2;
    int max_frames_in_flight = 4;
    double feed_idle_s = 30;
    int max_feeds = 16;
    bool reproducible = false;
    std::string record_dir;
    int record_mib = 4096;
  } mapping;
  struct Maps {
    double idle_close_s = 600;
  } maps;
  struct Store {
    int commit_frames = 50;
    double commit_s = 2.0;
    double max_behind_s = 30;
    double retry_s = 5.0;
    double busy_timeout_s = 5;
    int memory_budget_mib = 0;
    std::string spill_dir;
    bool backup_before_upgrade = true;
  } store;
  struct Watch {
    int max_watchers = 1000;
    int history_changes = 10'000;
    int history_mib = 32;
    double history_s = 86'400;
  } watch;
  struct Edits {
    int log_edits = 100'000;
    int log_mib = 64;
    double log_s = 2'592'000;
    int history_edits = 1000;
    int history_mib = 256;
    double history_s = 86'400;
  } edits;
  struct History {
    int kept_states = 64;
    int kept_states_mib = 256;
  } history;
  struct Limits {
    int query_points = 1'000'000;
    int pending_edits = 256;
    int inflight_mib = 256;
    int surface_mib = 512;
    int import_mib = 16'384;
    double import_idle_s = 30;
    int principal_maps = 100;
    int principal_disk_mib = 65'536;
    int principal_inflight_percent = 50;
  } limits;
  struct Fleet {
    std::string address;
    double lease_s = 2;
    std::string key_file;
    std::string ca;
  } fleet;
  double shutdown_grace_s = 2.0;

  /// For new maps without a preset.
  MapConfig map_defaults = IndoorConfig();

  /// INVALID_ARGUMENT naming every invalid key at once.
  [[nodiscard]] Status Validate() const;
};

/// Calls visit(key, member, least, most, help) for every field except those of map_defaults; least and most are ignored
/// for strings and booleans. This is the only list of keys: file, environment, flags and --print-config use it.
template <typename Config, typename Visitor>
void VisitServerFields(Config& c, Visitor&& visit) {
  visit("db", c.db, 0, 0,
        "SQLite file of the maps, or (experimental) postgresql://... of a database; required to serve");
  visit("insecure", c.insecure, 0, 0, "both of the next two; will go");
  visit("insecure_no_tls", c.insecure_no_tls, 0, 0, "allow addresses that other machines can reach, without TLS");
  visit("insecure_no_auth", c.insecure_no_auth, 0, 0, "allow addresses that other machines can reach, without keys");
  visit("grpc.address", c.grpc.address, 0, 0, "host:port, port 0 takes a free port; or unix:PATH");
  visit("grpc.max_message_mib", c.grpc.max_message_mib, 1, 2047,
        "MiB; larger requests are refused; requests without long lists are limited to 1 MiB");
  visit("grpc.num_threads", c.grpc.num_threads, 1, 256, "threads of the quick lane");
  visit("grpc.bulk_threads", c.grpc.bulk_threads, 0, 256,
        "threads for meshes, voxels and large queries, at lower priority; 0 = one per core");
  visit("grpc.max_connections", c.grpc.max_connections, 1, 1e6, "further connections are closed at once");
  visit("grpc.keepalive_s", c.grpc.keepalive_s, 1, 86400,
        "s of silence before a client is probed, and again before it is given up");
  visit("http.address", c.http.address, 0, 0, "host:port, port 0 takes a free port; or unix:PATH");
  visit("http.max_body_mib", c.http.max_body_mib, 1, 2047,
        "MiB; larger bodies are refused; requests without long lists are limited to 1 MiB");
  visit("http.num_threads", c.http.num_threads, 1, 256, "threads of the REST door");
  visit("http.allowed_hosts", c.http.allowed_hosts, 0, 0,
        "comma-separated Host names that are accepted besides the address and localhost");
  visit("http.allowed_origins", c.http.allowed_origins, 0, 0,
        "comma-separated origins (https://fleet.example) whose web pages may use the API");
  visit("http.max_connections", c.http.max_connections, 1, 1e6,
        "beyond it the longest idle connection is closed; if none is idle, 503");
  visit("http.idle_timeout_s", c.http.idle_timeout_s, 0.1, 86400,
        "s; a connection without a request is closed after this");
  visit("http.header_timeout_s", c.http.header_timeout_s, 0.1, 3600, "s that a request's header may take to arrive");
  visit("auth.keys", c.auth.keys, 0, 0,
        "file of keys, see `dhpmap keys`; empty = DB.keys, or the keys in a database server, if there are any");
  visit("auth.audit", c.auth.audit, 0, 0, "file for who changed what and who was refused, with keys on; empty = off");
  visit("auth.audit_required", c.auth.audit_required, 0, 0,
        "refuse what changes something while auth.audit cannot be written");
  visit("tls.cert", c.tls.cert, 0, 0,
        "PEM file of the certificate chain of both doors; empty = no TLS; read again when it changes");
  visit("tls.key", c.tls.key, 0, 0, "PEM file of its private key, which other users must not be able to read");
  visit("tls.client_ca", c.tls.client_ca, 0, 0, "PEM file of who signs the certificates of clients");
  visit("tls.client_auth", c.tls.client_auth, 0, 0, "none, optional or required: whether clients show certificates");
  visit("log.level", c.log.level, 0, 0, "debug, info, warning, error or off");
  visit("log.json", c.log.json, 0, 0, "write one JSON object per line");
  visit("mapping.num_threads", c.mapping.num_threads, 0, 256,
        "threads of fusion, shared by all maps; 0 = one per core");
  visit("mapping.publish_frames", c.mapping.publish_frames, 1, 1e6, "queries see a new state after this many frames");
  visit("mapping.publish_s", c.mapping.publish_s, 0, 3600,
        "s; or after this long; up to twice as long while planners ask for distances");
  visit("mapping.max_frames_in_flight", c.mapping.max_frames_in_flight, 1, 1000,
        "unacknowledged frames per stream; then the client waits");
  visit("mapping.feed_idle_s", c.mapping.feed_idle_s, 0, 86400,
        "s of silence after which a stream may be replaced, or its map deleted");
  visit("mapping.max_feeds", c.mapping.max_feeds, 1, 64, "named sessions that may feed one map at once");
  visit("mapping.reproducible", c.mapping.reproducible, 0, 0,
        "frames wait for refinement, so that the same frames always give the same map");
  visit("mapping.record_dir", c.mapping.record_dir, 0, 0,
        "folder that records frames and edits for `dhpmap replay`, a file per map; empty = off");
  visit("mapping.record_mib", c.mapping.record_mib, 1, 1e6,
        "MiB for all records in the folder; beyond it recording stops, mapping continues");
  visit("maps.idle_close_s", c.maps.idle_close_s, 0, 1e6,
        "s after which an unused map is closed and its memory freed; 0 = never");
  visit("store.commit_frames", c.store.commit_frames, 1, 1e6, "frames are stored after this many");
  visit("store.commit_s", c.store.commit_s, 0, 3600, "s; or after this long");
  visit("store.retry_s", c.store.retry_s, 0.01, 3600, "s between attempts while the store fails");
  visit("store.max_behind_s", c.store.max_behind_s, 0, 86400,
        "s that fused frames may stay unstored; then new frames are refused and /readyz fails");
  visit("store.busy_timeout_s", c.store.busy_timeout_s, 0, 600,
        "s to wait for another process that has the file locked");
  visit("store.memory_budget_mib", c.store.memory_budget_mib, 0, 1e8,
        "MiB of voxels in memory, of all maps together, read on demand; 0 = whole maps are read");
  visit("store.spill_dir", c.store.spill_dir, 0, 0,
        "folder for changed voxels that leave memory; empty = that of the file of maps");
  visit("store.backup_before_upgrade", c.store.backup_before_upgrade, 0, 0,
        "keep a copy, DB.before-vN, before a new version brings the database to schema N");
  visit("watch.max_watchers", c.watch.max_watchers, 1, 1e6, "watchers of all maps together; more are refused");
  visit("watch.history_changes", c.watch.history_changes, 1, 1e9,
        "commits per map whose changes are kept for watchers that resume");
  visit("watch.history_mib", c.watch.history_mib, 1, 1e6, "MiB per map for these in the file");
  visit("watch.history_s", c.watch.history_s, 0, 1e9, "s that these are kept");
  visit("edits.log_edits", c.edits.log_edits, 1, 1e9,
        "edits per map that the log keeps, with the answers to their requests");
  visit("edits.log_mib", c.edits.log_mib, 1, 1e6, "MiB per map for the log in the file");
  visit("edits.log_s", c.edits.log_s, 0, 1e9, "s that log entries are kept");
  visit("edits.history_edits", c.edits.history_edits, 0, 1e6, "edits per map that can be undone; 0 = none");
  visit("edits.history_mib", c.edits.history_mib, 0, 1e6, "MiB per map for what undoing them takes");
  visit("edits.history_s", c.edits.history_s, 0, 1e9, "s that edits can be undone");
  visit("history.kept_states", c.history.kept_states, 0, 1e5,
        "past states of each open map that can be read and restored; 0 = none");
  visit("history.kept_states_mib", c.history.kept_states_mib, 0, 1e6,
        "MiB of memory of past states, over all maps; the oldest are evicted");
  visit("limits.query_points", c.limits.query_points, 1, 1e9, "points in one QueryPoints");
  visit("limits.pending_edits", c.limits.pending_edits, 1, 1e6, "waiting edits per map; more are refused");
  visit("limits.inflight_mib", c.limits.inflight_mib, 16, 1e6,
        "MiB of requests and answers in memory, both doors together; frames have 3/4 as much more");
  visit("limits.surface_mib", c.limits.surface_mib, 16, 1e6,
        "MiB of cached surfaces for queries, of all maps together; unused ones are evicted");
  visit("limits.import_mib", c.limits.import_mib, 1, 1e7,
        "MiB of an imported map file; importing takes twice as much disk");
  visit("limits.import_idle_s", c.limits.import_idle_s, 0.1, 86400,
        "s that an import may lag behind 16 KiB/s in total");
  visit("limits.principal_maps", c.limits.principal_maps, 1, 1e6,
        "maps that one principal may create or import, with keys on");
  visit("limits.principal_disk_mib", c.limits.principal_disk_mib, 1, 1e9,
        "MiB of the maps that one principal has made; beyond it no more are made or fed");
  visit("limits.principal_inflight_percent", c.limits.principal_inflight_percent, 1, 100,
        "% of limits.inflight_mib that the calls of one principal may take");
  visit("fleet.address", c.fleet.address, 0, 0,
        "host:port of this server's gRPC for the others on its PostgreSQL database; empty = grpc.address");
  visit("fleet.lease_s", c.fleet.lease_s, 0.2, 60,
        "s of silence after which the others take this server's maps over; the same for all of them");
  visit("fleet.key_file", c.fleet.key_file, 0, 0,
        "file with the secret by which servers on one PostgreSQL database know each other; needed with keys");
  visit("fleet.ca", c.fleet.ca, 0, 0,
        "PEM file of who signs the other servers' certificates; empty = whom the system trusts");
  visit("shutdown_grace_s", c.shutdown_grace_s, 0, 60, "s that running calls get at shutdown");
}

/// `db` if it is a file; empty if it is a database URL.
std::string DatabaseFileOf(const ServerConfig& config);

/// The key file in use: `auth.keys`, or the one next to the database if that exists. Empty: no access control.
std::string KeyFileOf(const ServerConfig& config);

/// Keys whose values differ. A difference in map_defaults is listed once, as "map_defaults".
std::vector<std::string> ChangedKeys(const ServerConfig& before, const ServerConfig& after);

/// Whether a switch permits addresses that other machines can reach without TLS or without keys.
bool IsInsecure(const ServerConfig& config);

/// Checks the addresses of a server with or without a certificate and keys. INVALID_ARGUMENT, naming each address that
/// other machines can reach and what it lacks, unless a switch permits it.
Status CheckExposure(const ServerConfig& config, bool has_tls, bool has_keys);

/// "a, b" -> {"a", "b"}.
std::vector<std::string> SplitByComma(const std::string& text);

/// "DHPMAP_GRPC_ADDRESS" for "grpc.address".
std::string EnvironmentName(std::string_view key);

/// True for host:port with a loopback host (127.x.x.x, localhost, [::1]) and for unix: sockets.
bool IsLoopback(std::string_view address);

}  // namespace dhpmap
