// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/status.h"
#include "mapping/map/map_config.h"

namespace dhpmap {

/// Everything that can be set of the server. Order: these defaults < file < environment < flags.
struct ServerConfig {
  std::string db;  ///< the SQLite file with the maps; required to serve
  bool insecure = false;

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
    int max_connections = 1000;
    double idle_timeout_s = 60;
    double head_timeout_s = 10;
  } http;
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
    int busy_timeout_ms = 5000;
    int memory_budget_mib = 0;
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
  } limits;
  double shutdown_grace_s = 2.0;

  /// Of a new map that names no preset.
  MapConfig map_defaults = IndoorConfig();

  /// INVALID_ARGUMENT naming every key that is not usable, at once.
  [[nodiscard]] Status Validate() const;
};

/// Calls visit(key, member, least, most, help) for every field but those of map_defaults; least and most mean nothing
/// for text and switches. The one list of keys: file, environment, flags and --print-config all go through it.
template <typename Config, typename Visitor>
void VisitServerFields(Config& c, Visitor&& visit) {
  visit("db", c.db, 0, 0, "the SQLite file with the maps; required to serve");
  visit("insecure", c.insecure, 0, 0,
        "allow addresses that other machines can reach, although there is no TLS and no authentication");
  visit("grpc.address", c.grpc.address, 0, 0, "host:port; port 0 takes a free one");
  visit("grpc.max_message_mib", c.grpc.max_message_mib, 1, 2047,
        "MiB; a larger request is refused, and one without long lists beyond 1 MiB");
  visit("grpc.num_threads", c.grpc.num_threads, 1, 256, "threads that answer what is quick");
  visit("grpc.bulk_threads", c.grpc.bulk_threads, 0, 256,
        "threads for meshes, voxels and many points, at lower priority; 0 = one a core");
  visit("grpc.max_connections", c.grpc.max_connections, 1, 1e6, "one more is closed at once");
  visit("grpc.keepalive_s", c.grpc.keepalive_s, 1, 86400,
        "s of silence after which a client is asked whether it is there, and again until it is given up");
  visit("http.address", c.http.address, 0, 0, "host:port; port 0 takes a free one");
  visit("http.max_body_mib", c.http.max_body_mib, 1, 2047,
        "MiB; a larger body is refused, and one without long lists beyond 1 MiB");
  visit("http.num_threads", c.http.num_threads, 1, 256, "threads of the REST door");
  visit("http.allowed_hosts", c.http.allowed_hosts, 0, 0,
        "names that requests may be for besides the address and localhost, separated by commas");
  visit("http.max_connections", c.http.max_connections, 1, 1e6, "the idlest is closed for one more; if none is, 503");
  visit("http.idle_timeout_s", c.http.idle_timeout_s, 0.1, 86400, "s; a connection without a request is closed then");
  visit("http.head_timeout_s", c.http.head_timeout_s, 0.1, 3600, "s that a request's head may take to arrive");
  visit("log.level", c.log.level, 0, 0, "debug, info, warning, error or off");
  visit("log.json", c.log.json, 0, 0, "write one JSON object a line");
  visit("mapping.num_threads", c.mapping.num_threads, 0, 256,
        "threads of fusion, of all maps together; 0 = one a core");
  visit("mapping.publish_frames", c.mapping.publish_frames, 1, 1e6, "queries see frames after so many of them");
  visit("mapping.publish_s", c.mapping.publish_s, 0, 3600,
        "s; or after so long; while planners ask for distances, up to twice that");
  visit("mapping.max_frames_in_flight", c.mapping.max_frames_in_flight, 1, 1000,
        "of a stream, read but not yet acknowledged; then the client has to wait");
  visit("mapping.feed_idle_s", c.mapping.feed_idle_s, 0, 86400,
        "s of silence after which a stream makes place for another, or for the deletion of its map");
  visit("mapping.max_feeds", c.mapping.max_feeds, 1, 64, "named sessions that may feed one map at once");
  visit("mapping.reproducible", c.mapping.reproducible, 0, 0,
        "frames wait for refinements that cannot keep up, so that the same frames give the same map");
  visit(
      "mapping.record_dir", c.mapping.record_dir, 0, 0,
      "folder in which frames and edits are kept as they came, a file a map, for dhpmap replay; empty = they are not");
  visit("mapping.record_mib", c.mapping.record_mib, 1, 1e6,
        "MiB that all records in the folder may take; then recording stops, and mapping goes on");
  visit("maps.idle_close_s", c.maps.idle_close_s, 0, 1e6,
        "s after which a map that nobody uses is closed, and its memory freed; 0 = never");
  visit("store.commit_frames", c.store.commit_frames, 1, 1e6, "frames go to the store after so many of them");
  visit("store.commit_s", c.store.commit_s, 0, 3600, "s; or after so long");
  visit("store.retry_s", c.store.retry_s, 0.01, 3600, "s between attempts while the store refuses");
  visit("store.max_behind_s", c.store.max_behind_s, 0, 86400,
        "s that fused frames may wait to be stored; then further ones are refused, and /readyz says so");
  visit("store.busy_timeout_ms", c.store.busy_timeout_ms, 0, 600000, "ms to wait for another reader of the file");
  visit("store.memory_budget_mib", c.store.memory_budget_mib, 0, 1e8,
        "MiB of voxels in memory, of all maps together: they are read when they are needed, and left on the disk near "
        "it, what was mapped since it was read in a file without a name beside the database; requests that would hold "
        "more than half of it, or 64 MiB if that is more, are refused. 0 = maps are read as a whole");
  visit("watch.max_watchers", c.watch.max_watchers, 1, 1e6, "of all maps together; more are refused");
  visit("watch.history_changes", c.watch.history_changes, 1, 1e9,
        "commits whose changes are kept of each map, for who watches it from then on");
  visit("watch.history_mib", c.watch.history_mib, 1, 1e6, "MiB that these may take of each map in the file");
  visit("watch.history_s", c.watch.history_s, 0, 1e9, "s that they are kept");
  visit("edits.log_edits", c.edits.log_edits, 1, 1e9,
        "edits that the log of each map keeps, with what their requests were answered");
  visit("edits.log_mib", c.edits.log_mib, 1, 1e6, "MiB that these may take of each map in the file");
  visit("edits.log_s", c.edits.log_s, 0, 1e9, "s that they are kept");
  visit("edits.history_edits", c.edits.history_edits, 0, 1e6, "edits of each map that can be undone; 0 = none");
  visit("edits.history_mib", c.edits.history_mib, 0, 1e6, "MiB that what it takes to undo them may take of each map");
  visit("edits.history_s", c.edits.history_s, 0, 1e9, "s that it is kept");
  visit("history.kept_states", c.history.kept_states, 0, 1e5,
        "states of each open map, of those stored last, that can be read and restored; 0 = none but the present one");
  visit("history.kept_states_mib", c.history.kept_states_mib, 0, 1e6,
        "MiB of memory for what these have that later ones do not share, of all maps together; the oldest go first");
  visit("limits.query_points", c.limits.query_points, 1, 1e9, "points in one QueryPoints");
  visit("limits.pending_edits", c.limits.pending_edits, 1, 1e6, "of a map; more are refused");
  visit("limits.inflight_mib", c.limits.inflight_mib, 16, 1e6,
        "MiB of requests and answers in memory at once, at both doors together; more are refused. A quarter is for "
        "what gRPC holds; frames have three quarters as much of their own, which no other call can take from a robot");
  visit("limits.surface_mib", c.limits.surface_mib, 16, 1e6,
        "MiB of surfaces kept for distances, of all maps together; those not asked about for longest go first");
  visit("limits.import_mib", c.limits.import_mib, 1, 1e7,
        "MiB that the file of a map that comes in may have; it takes twice as much of the disk");
  visit("limits.import_idle_s", c.limits.import_idle_s, 0.1, 86400,
        "s that one that comes in may be behind 16 KiB/s, all in all");
  visit("shutdown_grace_s", c.shutdown_grace_s, 0, 60, "s that running calls get at the end");
}

/// "DHPMAP_GRPC_ADDRESS" for "grpc.address".
std::string EnvironmentName(std::string_view key);

/// True for host:port with a loopback host (127.x.x.x, localhost, [::1]) and for unix: sockets.
bool IsLoopback(std::string_view address);

}  // namespace dhpmap
