// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/app/maps/map_registry.h"
#include "server/auth/gate.h"
#include "server/config/server_config.h"
#include "server/gateway/gateway.h"
#include "server/grpc/grpc_server.h"
#include "server/log/log.h"
#include "server/metrics/metrics.h"
#include "server/net/tls_context.h"
#include "server/record/map_recorder.h"
#include "storage/store.h"

namespace dhpmap {

// From the configuration to what each room wants to know. `metrics` outlives what hooks are made for.
LogOptions LogOptionsOf(const ServerConfig& config);
/// Hears what a store does while it opens: the steps of a migration.
using StoreProgress = std::function<void(const std::string& message)>;
/// In the file, or the PostgreSQL database, that is configured. FAILED_PRECONDITION for settings that it cannot serve.
Result<std::unique_ptr<MapStore>> OpenStore(const ServerConfig& config, StoreProgress on_progress);
/// Null where nothing is recorded.
Result<std::unique_ptr<RecordDir>> RecordDirOf(const ServerConfig& config);
/// `records` may be null, and outlives the sessions.
OpenMapOptions OpenMapOptionsOf(const ServerConfig& config, Metrics& metrics, RecordDir* records,
                                std::shared_ptr<TileSpill> spill);
RegistryOptions RegistryOptionsOf(const ServerConfig& config);
/// Beside the database; null where memory has no budget.
Result<std::shared_ptr<TileSpill>> SpillOf(const ServerConfig& config);
/// For both doors together.
std::shared_ptr<ByteBudget> InflightBudgetOf(const ServerConfig& config);
/// Admits callers with a key of the file, or of the database, that is in force; without keys everybody. `server`: its
/// FleetServer::id, or 0. Errors as of Gate::WithKeys and OpenAuthTables; INVALID_ARGUMENT, reason BAD_CONFIG, if there
/// are keys in both, or if other machines reach a server without keys.
Result<std::shared_ptr<auth::Gate>> GateOf(const ServerConfig& config, std::int64_t server);
/// Of both doors; null where there is none.
Result<std::shared_ptr<net::TlsContext>> TlsOf(const ServerConfig& config);
GrpcOptions GrpcOptionsOf(const ServerConfig& config, std::shared_ptr<ByteBudget> inflight,
                          std::shared_ptr<auth::Gate> gate, std::shared_ptr<const net::TlsContext> tls);
/// What the other servers on the same database, and their clients, call this one by.
std::string FleetAddressOf(const ServerConfig& config, int grpc_port);
GrpcObserver ObserverOf(Metrics& metrics);
GatewayOptions GatewayOptionsOf(const ServerConfig& config, std::shared_ptr<ByteBudget> inflight, Metrics& metrics,
                                std::shared_ptr<const net::TlsContext> tls);

/// Of the maps that are open now, and of what there is for those who ask. Visits every block, which takes milliseconds.
Metrics::Gauges GaugesOf(const MapRegistry& registry, const ByteBudget& inflight, const GrpcServer& grpc,
                         const RecordDir* records, const TileSpill* spill);
/// Of a server that shares its database with others; `followed`: its copies, may be null.
Metrics::FleetGauges FleetGaugesOf(const Fleet& fleet, const FollowedMaps* followed);
/// Whether a map has waited for its store for longer than that.
bool IsStoreBehind(const MapRegistry& registry, double max_behind_s);

/// The address with the port that was taken in place of 0.
std::string WithPort(const std::string& address, int port);

}  // namespace dhpmap
