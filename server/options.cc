// SPDX-License-Identifier: BSD-3-Clause
#include "server/options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "mapping/paging/page_reader.h"
#include "mapping/paging/tile_page.h"
#include "server/app/maps/map_stats.h"
#include "storage/postgres_store.h"
#include "storage/sqlite_store.h"

namespace dhpmap {
namespace {

/// Of a map's memory_bytes, what MemoryKind::kBlocks counts.
std::int64_t CountedBlockBytes(const MapStats& stats) {
  return stats.num_tsdf_blocks_in_memory * static_cast<std::int64_t>(sizeof(TsdfBlock)) +
         stats.label_plane_bytes_in_memory;
}

ChangeHistoryLimits ChangeLimitsOf(const ServerConfig& config) {
  return {.max_changes = config.watch.history_changes,
          .max_bytes = std::int64_t{config.watch.history_mib} << 20,
          .max_age_s = config.watch.history_s};
}

EditLogLimits EditLimitsOf(const ServerConfig& config) {
  return {.max_edits = config.edits.log_edits,
          .max_bytes = std::int64_t{config.edits.log_mib} << 20,
          .max_age_s = config.edits.log_s,
          .max_histories = config.edits.history_edits,
          .max_history_bytes = std::int64_t{config.edits.history_mib} << 20,
          .max_history_age_s = config.edits.history_s};
}

SqliteStoreOptions SqliteOptionsOf(const ServerConfig& config, StoreProgress on_progress) {
  return {.busy_timeout_ms = static_cast<int>(std::lround(1000 * config.store.busy_timeout_s)),
          .on_progress = std::move(on_progress),
          .keeps_copy_before_migration = config.store.backup_before_upgrade,
          .changes = ChangeLimitsOf(config),
          .edits = EditLimitsOf(config),
          .pages_tiles = config.store.memory_budget_mib > 0};
}

}  // namespace

LogOptions LogOptionsOf(const ServerConfig& config) {
  LogOptions options{.json_lines = config.log.json};
  if (const auto level = LogLevelFromName(config.log.level); level.ok()) options.level = *level;
  return options;
}

Result<std::unique_ptr<MapStore>> OpenStore(const ServerConfig& config, StoreProgress on_progress) {
  if (!IsPostgresUrl(config.db)) return OpenSqliteStore(config.db, SqliteOptionsOf(config, std::move(on_progress)));
  LogWarning("the store on PostgreSQL is experimental");
  // Its address is announced when the door is open.
  return OpenPostgresStore(config.db, {.changes = ChangeLimitsOf(config),
                                       .edits = EditLimitsOf(config),
                                       .pages_tiles = config.store.memory_budget_mib > 0,
                                       .on_progress = std::move(on_progress),
                                       .fleet = {.version = DHPMAP_VERSION, .lease_s = config.fleet.lease_s}});
}

Result<std::unique_ptr<RecordDir>> RecordDirOf(const ServerConfig& config) {
  if (config.mapping.record_dir.empty()) return std::unique_ptr<RecordDir>();
  return RecordDir::Open(config.mapping.record_dir, std::int64_t{config.mapping.record_mib} << 20);
}

Result<std::shared_ptr<TileSpill>> SpillOf(const ServerConfig& config) {
  if (config.store.memory_budget_mib == 0) return std::shared_ptr<TileSpill>();
  if (!config.store.spill_dir.empty()) return OpenTileSpill(config.store.spill_dir);
  if (IsPostgresUrl(config.db)) {
    return FailedPrecondition(
        "store.memory_budget_mib with a store on PostgreSQL needs store.spill_dir: a folder on a disk, for changed "
        "voxels "
        "that leave memory");
  }
  const std::string folder = std::filesystem::path(config.db).parent_path().string();
  return OpenTileSpill(folder.empty() ? "." : folder);
}

OpenMapOptions OpenMapOptionsOf(const ServerConfig& config, Metrics& metrics, RecordDir* records,
                                std::shared_ptr<TileSpill> spill) {
  const bool is_reproducible = config.mapping.reproducible;
  MakeRecorder make_recorder;
  if (records != nullptr) {
    make_recorder = [records, is_reproducible](const MapInfo& map) {
      return RecordMap(
          map, *records,
          {.is_reproducible = is_reproducible, .on_stopped = [](const std::string& message) { LogWarning(message); }});
    };
  }
  return {
      .mapping = {.num_threads = config.mapping.num_threads,
                  .refinement_timing = is_reproducible ? RefinementTiming::kReproducible : RefinementTiming::kNeverWait,
                  .on_refinement =
                      [&metrics](const RefinementReport& report) {
                        metrics.RecordRefinement(report.management_s, report.crf_s);
                      }},
      .publish = {.frames = config.mapping.publish_frames, .delay_s = config.mapping.publish_s},
      .commit = {.frames = config.store.commit_frames,
                 .delay_s = config.store.commit_s,
                 .retry_s = config.store.retry_s,
                 .max_behind_s = config.store.max_behind_s,
                 .on_commit =
                     [&metrics](double seconds, const Status& status) {
                       metrics.RecordCommit(status.code(), seconds);
                       if (status.reason() == Reason("NOT_OWNER")) LogWarning(status.ToString());
                       else if (!status.ok()) LogError("commit failed, will be tried again: " + status.ToString());
                     }},
      .pages = {.budget_bytes = std::int64_t{config.store.memory_budget_mib} << 20, .spill = std::move(spill)},
      .feeds = {.idle_s = config.mapping.feed_idle_s, .max_feeds = static_cast<std::size_t>(config.mapping.max_feeds)},
      .history = {.max_states = static_cast<std::size_t>(config.history.kept_states),
                  .bytes = static_cast<std::size_t>(config.history.kept_states_mib) << 20},
      .max_pending_edits = static_cast<std::size_t>(config.limits.pending_edits),
      .make_recorder = std::move(make_recorder)};
}

namespace {

void WarnOfRetiredSettings(const MapInfo& map) {
  for (const std::string& setting : map.config.left_out) {
    LogWarning("map '" + map.name + "' goes on without " + setting + ", which this version no longer has");
  }
}

}  // namespace

RegistryOptions RegistryOptionsOf(const ServerConfig& config) {
  return {.idle_close_s = config.maps.idle_close_s,
          .surface_bytes = static_cast<std::size_t>(config.limits.surface_mib) << 20,
          .max_watchers = static_cast<std::size_t>(config.watch.max_watchers),
          .max_import_bytes = std::int64_t{config.limits.import_mib} << 20,
          .on_loaded = WarnOfRetiredSettings};
}

std::shared_ptr<ByteBudget> InflightBudgetOf(const ServerConfig& config) {
  // What a planner asks for at 100 Hz is smaller, and is answered whatever others hold.
  constexpr std::size_t kSmallBytes = 16u << 10;
  // A quarter is for what nobody can count: what gRPC has taken in before it makes a message of it, and what it has not
  // sent yet. With eight clients that ask for much it was 40 to 57 of 256 MiB.
  const std::size_t all = static_cast<std::size_t>(config.limits.inflight_mib) << 20;
  return std::make_shared<ByteBudget>(all - all / 4, kSmallBytes);
}

Result<std::shared_ptr<net::TlsContext>> TlsOf(const ServerConfig& config) {
  if (!config.tls.is_on()) return std::shared_ptr<net::TlsContext>();
  DHPMAP_ASSIGN_OR_RETURN(const net::ClientAuth client_auth, net::ClientAuthFromName(config.tls.client_auth));
  return net::TlsContext::Load(
      {.cert = config.tls.cert, .key = config.tls.key, .client_ca = config.tls.client_ca, .client_auth = client_auth});
}

GrpcOptions GrpcOptionsOf(const ServerConfig& config, std::shared_ptr<ByteBudget> inflight,
                          std::shared_ptr<auth::Gate> gate, std::shared_ptr<const net::TlsContext> tls) {
  return {
      .address = config.grpc.address,
      .tls = std::move(tls),
      .max_message_bytes = static_cast<std::size_t>(config.grpc.max_message_mib) << 20,
      .num_threads = config.grpc.num_threads,
      .num_bulk_threads = config.grpc.bulk_threads,
      .inflight = std::move(inflight),
      .max_connections = config.grpc.max_connections,
      .keepalive_s = config.grpc.keepalive_s,
      .import_idle_s = config.limits.import_idle_s,
      .max_query_points = config.limits.query_points,
      .max_frames_in_flight = config.mapping.max_frames_in_flight,
      .default_config = config.map_defaults,
      .version = DHPMAP_VERSION,
      .database = DatabaseFileOf(config),
      .max_behind_s = config.store.max_behind_s,
      .gate = std::move(gate),
      .peer_tls = {.is_on = config.tls.is_on(), .ca = config.fleet.ca, .cert = config.tls.cert, .key = config.tls.key}};
}

std::string FleetAddressOf(const ServerConfig& config, int grpc_port) {
  return config.fleet.address.empty() ? WithPort(config.grpc.address, grpc_port) : config.fleet.address;
}

GrpcObserver ObserverOf(Metrics& metrics) {
  return {.on_call = [&metrics](std::string_view method, StatusCode code,
                                double seconds) { metrics.RecordCall(method, code, seconds); },
          .on_query = [&metrics](std::size_t num_points) { metrics.RecordQuery(num_points); },
          .on_frame = [&metrics](StatusCode code) { metrics.RecordFrame(code); },
          .on_relayed = [&metrics](std::string_view, StatusCode code) { metrics.RecordRelayed(code); },
          .on_refused = [&metrics](std::string_view door, std::string_view why) { metrics.RecordRefused(door, why); }};
}

GatewayOptions GatewayOptionsOf(const ServerConfig& config, std::shared_ptr<ByteBudget> inflight, Metrics& metrics,
                                std::shared_ptr<const net::TlsContext> tls) {
  return {.address = config.http.address,
          .tls = std::move(tls),
          .on_refused = [&metrics](std::string_view why) { metrics.RecordRefused("rest", why); },
          .max_body_bytes = static_cast<std::size_t>(config.http.max_body_mib) << 20,
          .inflight = std::move(inflight),
          .num_threads = config.http.num_threads,
          .allowed_hosts = SplitByComma(config.http.allowed_hosts),
          .allowed_origins = SplitByComma(config.http.allowed_origins),
          .max_connections = config.http.max_connections,
          .idle_timeout_s = config.http.idle_timeout_s,
          .head_timeout_s = config.http.header_timeout_s};
}

Metrics::FleetGauges FleetGaugesOf(const Fleet& fleet, const FollowedMaps* followed) {
  const FleetCounts counts = fleet.Counts();
  const FollowingState following =
      followed != nullptr ? followed->StateAt(FollowedMaps::Clock::now()) : FollowingState();
  return {.num_owned = counts.num_owned,
          .num_taken_over = counts.num_taken_over,
          .num_lost = counts.num_lost,
          .num_failed_beats = counts.num_failed_beats,
          .num_copies = following.num_copies,
          .copy_bytes = following.bytes,
          .copies_behind_s = following.behind_s,
          .schema = fleet.Schema().in_force};
}

Metrics::Gauges GaugesOf(const MapRegistry& registry, const ByteBudget& inflight, const GrpcServer& grpc,
                         const RecordDir* records, const TileSpill* spill) {
  Metrics::Gauges gauges{.surface_bytes = registry.surface_bytes(),
                         .num_watchers = registry.changes().num_followers(),
                         .inflight_bytes = inflight.used_bytes(),
                         .record_bytes = records != nullptr ? records->num_bytes() : 0,
                         .store_bytes = SqliteMemoryBytes(),
                         .frame_bytes = grpc.frame_bytes()};
  const PageCounts pages = CountPages();
  gauges.page_bytes = pages.resident_bytes;
  gauges.num_pages_read = pages.num_reads;
  gauges.num_page_hits = pages.num_hits;
  gauges.num_pages_unreadable = pages.num_failures;
  gauges.page_read_ns = pages.read_ns;
  gauges.page_held_bytes = PageReaderBytes();
  gauges.num_pages_evicted = pages.num_evicted;
  gauges.num_spilled = pages.num_spilled;
  gauges.num_unspilled = pages.num_unspilled;
  gauges.spill_bytes = spill != nullptr ? spill->size_bytes() : 0;
  for (const auto& open_map : registry.OpenMaps()) {
    const auto view = open_map->View();
    const MapStats stats = ComputeStats(view->snapshot(), /*with_voxels=*/false);
    gauges.past_bytes += open_map->history()->bytes();
    gauges.maps.push_back({.name = view->snapshot().info().name,
                           .num_submaps = stats.num_submaps,
                           .num_blocks = stats.num_tsdf_blocks,
                           .revision = view->snapshot().revision(),
                           .memory_bytes = stats.memory_bytes,
                           .num_feeds = static_cast<std::int64_t>(open_map->num_feeds()),
                           .behind_s = open_map->BehindSeconds(),
                           .block_bytes = CountedBlockBytes(stats)});
  }
  return gauges;
}

bool IsStoreBehind(const MapRegistry& registry, double max_behind_s) {
  const auto sessions = registry.OpenMaps();
  return std::any_of(sessions.begin(), sessions.end(),
                     [max_behind_s](const auto& open_map) { return open_map->BehindSeconds() > max_behind_s; });
}

std::string WithPort(const std::string& address, int port) {
  const std::size_t colon = address.rfind(':');
  if (address.starts_with("unix:") || colon == std::string::npos) return address;
  return address.substr(0, colon + 1) + std::to_string(port);
}

}  // namespace dhpmap
