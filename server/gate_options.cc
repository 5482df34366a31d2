// SPDX-License-Identifier: BSD-3-Clause
// Where keys, audit log and makers of maps are: in files of this server, or in the database that several share.
#include <utility>

#include "server/auth/keys/key_table.h"
#include "server/auth/map_owners_table.h"
#include "server/options.h"
#include "storage/auth_tables.h"

namespace dhpmap {
namespace {

void TellFault(const Status& fault) { LogError("keys or their log: it goes on with what it has: " + fault.ToString()); }

/// Null where there is none.
Result<std::shared_ptr<const auth::FleetKey>> FleetKeyOf(const ServerConfig& config) {
  if (config.fleet.key_file.empty()) return std::shared_ptr<const auth::FleetKey>();
  return auth::FleetKey::Read(config.fleet.key_file);
}

auth::GateOptions OptionsOf(const ServerConfig& config, const std::string& key_file) {
  return {.key_file = key_file,
          .audit_file = config.auth.audit,
          .is_audit_required = config.auth.audit_required,
          .owners_file = (DatabaseFileOf(config).empty() ? key_file : config.db) + ".owners",
          .limits = {.maps = config.limits.principal_maps,
                     .disk_bytes = static_cast<std::int64_t>(config.limits.principal_disk_mib) << 20,
                     .inflight_fraction = config.limits.principal_inflight_percent / 100.0},
          .on_fault = TellFault};
}

/// Null without keys.
Result<std::shared_ptr<auth::Gate>> GateOnFile(const ServerConfig& config) {
  const std::string file = KeyFileOf(config);
  if (file.empty()) return std::shared_ptr<auth::Gate>();
  LogInfo("with the keys of " + file);
  return auth::Gate::WithKeys(OptionsOf(config, file));
}

/// Beside servers of the last release, which keep the database from having the tables of keys.
Result<std::shared_ptr<auth::Gate>> GateDuringUpgrade(const ServerConfig& config) {
  DHPMAP_RETURN_IF_ERROR(CheckExposure(config, config.tls.is_on(), !KeyFileOf(config).empty()));
  LogInfo("keys and audit log are files until the database is upgraded and this server starts again");
  return GateOnFile(config);
}

/// Keys are those of the database if it has any, or else of the file that auth.keys names. Null without keys.
Result<std::shared_ptr<auth::Gate>> GateOnDatabase(const ServerConfig& config, std::int64_t server) {
  auto opened = OpenAuthTables(config.db);
  if (opened.status().reason() == Reason("OLDER_SCHEMA")) return GateDuringUpgrade(config);
  DHPMAP_ASSIGN_OR_RETURN(std::shared_ptr<AuthTables> tables, std::move(opened));
  DHPMAP_ASSIGN_OR_RETURN(const auth::KeyTableContent keys, auth::ReadKeyTable(*tables));
  const std::string file = KeyFileOf(config);
  if (!file.empty() && !keys.records.empty()) {
    return InvalidArgument("the database has keys, and auth.keys names a file of others: which of them count?")
        .WithReason("BAD_CONFIG");
  }
  const bool has_keys = !file.empty() || !keys.records.empty();
  DHPMAP_RETURN_IF_ERROR(CheckExposure(config, config.tls.is_on(), has_keys));
  if (!has_keys) return std::shared_ptr<auth::Gate>();
  auth::GateOptions options = OptionsOf(config, file);
  if (file.empty()) options.keys = std::make_shared<auth::KeyTableSource>(tables);
  LogInfo("with the keys of " + (file.empty() ? "the database" : file));
  options.owners = std::make_shared<auth::MapOwnersTable>(tables);
  options.audit_table =
      std::make_shared<auth::AuditTable>(tables, auth::AuditTableOptions{.server = server, .on_fault = TellFault});
  return auth::Gate::WithKeys(std::move(options));
}

}  // namespace

Result<std::shared_ptr<auth::Gate>> GateOf(const ServerConfig& config, std::int64_t server) {
  if (IsInsecure(config)) {
    LogWarning(
        "started to let strangers in where nothing keeps them out: insecure, insecure_no_tls or insecure_no_auth");
  }
  DHPMAP_ASSIGN_OR_RETURN(auto fleet_key, FleetKeyOf(config));
  const bool is_file = !DatabaseFileOf(config).empty();
  DHPMAP_ASSIGN_OR_RETURN(std::shared_ptr<auth::Gate> gate,
                          is_file ? GateOnFile(config) : GateOnDatabase(config, server));
  if (gate == nullptr) {
    LogInfo("without keys: whoever reaches a door may do everything");
    gate = auth::Gate::Open();
  }
  gate->TakeFleetKey(std::move(fleet_key));
  return gate;
}

}  // namespace dhpmap
