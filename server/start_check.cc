// SPDX-License-Identifier: BSD-3-Clause
#include "server/start_check.h"

#include <arpa/inet.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "server/auth/fleet_key.h"
#include "server/auth/keys/key_file.h"
#include "server/net/address.h"
#include "server/net/listening.h"
#include "server/options.h"
#include "storage/sqlite_store.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

std::string Mebibytes(std::int64_t bytes) { return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB"; }

void AddFault(const std::string& what, const Status& status, StartCheck& check) {
  if (!status.ok()) check.faults.push_back(what + ": " + status.message());
}

/// The nearest folder above `path` that is there, or itself if it is one.
fs::path FolderThatIsThere(const fs::path& path) {
  std::error_code error;
  fs::path folder = path.empty() ? "." : path;
  while (!fs::exists(folder, error) && folder.has_parent_path() && folder != folder.parent_path()) {
    folder = folder.parent_path();
  }
  return fs::exists(folder, error) ? folder : ".";
}

bool MayMakeFilesIn(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder, error) && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

void CheckTls(const ServerConfig& config, StartCheck& check) {
  const auto tls = TlsOf(config);
  AddFault("tls", tls.status(), check);
  if (tls.ok() && *tls != nullptr) check.notes.push_back("TLS with the certificate of " + (*tls)->Describe());
}

void CheckKeys(const ServerConfig& config, StartCheck& check) {
  const std::string file = KeyFileOf(config);
  if (file.empty()) {
    check.notes.emplace_back(DatabaseFileOf(config).empty()
                                 ? "with the keys of the database if it has any, which was not asked"
                                 : "without keys: whoever reaches a door may do everything");
    return;
  }
  const auto content = auth::ReadKeyFile(file);
  AddFault("auth.keys", content.status(), check);
  if (content.ok() && content->records.empty()) check.faults.push_back("auth.keys: " + file + " has no key");
  if (content.ok()) {
    check.notes.push_back("with the keys of " + file + ", of which there are " +
                          std::to_string(content->records.size()));
  }
  const fs::path audit = config.auth.audit;
  if (audit.empty()) return;
  std::error_code error;
  const bool may_be_written = fs::exists(audit, error)
                                  ? fs::is_regular_file(audit, error) && ::access(audit.c_str(), W_OK) == 0
                                  : MayMakeFilesIn(audit.has_parent_path() ? audit.parent_path() : ".");
  if (!may_be_written) check.faults.push_back("auth.audit: " + audit.string() + " cannot be written");
}

void CheckFleetKey(const ServerConfig& config, StartCheck& check) {
  if (config.fleet.key_file.empty()) return;
  AddFault("fleet.key_file", auth::FleetKey::Read(config.fleet.key_file).status(), check);
}

void CheckUpgrade(const ServerConfig& config, const DatabaseLook& look, StartCheck& check) {
  if (look.copy_bytes == 0) return;
  const std::string steps = "the database would be brought from schema " + std::to_string(look.schema) + " to " +
                            std::to_string(look.server_schema);
  if (!config.store.backup_before_upgrade) {
    check.notes.push_back(steps + ", without a copy of it as it is");
  } else if (look.has_room_for_copy) {
    check.notes.push_back(steps + "; a copy, of some " + Mebibytes(look.copy_bytes) + ", would be kept in " +
                          look.copy_path);
  } else {
    check.faults.push_back("db: " + steps + ", and there is no room to keep a copy: that takes " +
                           Mebibytes(look.copy_bytes) + " and 64 MiB to spare, and " + Mebibytes(look.free_bytes) +
                           " are free. Make room, or go without (--no-backup)");
  }
}

/// Whether a server runs on it.
bool CheckDatabase(const ServerConfig& config, StartCheck& check) {
  if (DatabaseFileOf(config).empty()) {
    check.notes.emplace_back("the database server was not asked");
    return false;
  }
  const auto look = LookAtDatabase(config.db);
  AddFault("db", look.status(), check);
  if (!look.ok()) return false;
  if (!look->is_there) check.notes.push_back("the database " + config.db + " is not there yet and would be made");
  if (!look->holder.empty()) {
    check.notes.push_back("the database is in use by " + look->holder +
                          ": its contents and the ports were not tried, and it has to end first");
  }
  CheckUpgrade(config, *look, check);
  return !look->holder.empty();
}

Status CheckSocketPath(const fs::path& path) {
  if (path.string().size() >= sizeof(sockaddr_un::sun_path))
    return InvalidArgument("the path is too long for a socket");
  if (MayMakeFilesIn(path.has_parent_path() ? path.parent_path() : ".")) return Status::Ok();
  return Unavailable("a socket cannot be made in the folder of " + path.string());
}

/// The REST door takes no names, which might be of several addresses.
Status CheckRestHost(const std::string& address) {
  DHPMAP_ASSIGN_OR_RETURN(const net::Address parts, net::SplitAddress(address));
  std::array<unsigned char, sizeof(in6_addr)> ignored{};
  const bool is_number = ::inet_pton(AF_INET, parts.host.c_str(), ignored.data()) == 1 ||
                         ::inet_pton(AF_INET6, parts.host.c_str(), ignored.data()) == 1;
  if (is_number || parts.host == "localhost") return Status::Ok();
  return InvalidArgument("'" + address + "' is no address: the host must be an IP address or localhost");
}

void CheckDoors(const ServerConfig& config, const service::InheritedSockets& sockets, StartCheck& check) {
  std::vector<net::Listening> taken;  // both at once: they may be the same
  const auto try_door = [&](const char* key, const std::string& address, bool is_inherited) {
    if (is_inherited) return check.notes.push_back(std::string(key) + ": a socket was handed over, at " + address);
    if (address.starts_with("unix:")) return AddFault(key, CheckSocketPath(address.substr(5)), check);
    auto listening = net::ListenOn(address);
    AddFault(key, listening.status(), check);
    if (listening.ok()) taken.push_back(std::move(*listening));
  };
  try_door("grpc.address", config.grpc.address, !sockets.grpc.empty());
  const bool has_socket = !sockets.rest.empty() || config.http.address.starts_with("unix:");
  const Status host = has_socket ? Status::Ok() : CheckRestHost(config.http.address);
  AddFault("http.address", host, check);
  if (host.ok()) try_door("http.address", config.http.address, !sockets.rest.empty());
}

void CheckRecords(const ServerConfig& config, StartCheck& check) {
  const std::string& folder = config.mapping.record_dir;
  if (folder.empty() || MayMakeFilesIn(FolderThatIsThere(folder))) return;
  check.faults.push_back("mapping.record_dir: files cannot be made in " + folder);
}

}  // namespace

Status UseAddressesOf(const service::InheritedSockets& sockets, ServerConfig& config) {
  if (!sockets.grpc.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(config.grpc.address, service::AddressOf(sockets.grpc, IsLoopback));
  }
  if (!sockets.rest.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(config.http.address, service::AddressOf(sockets.rest, IsLoopback));
  }
  return sockets.empty() ? Status::Ok() : config.Validate();
}

StartCheck CheckStart(const ServerConfig& config, const service::InheritedSockets& sockets) {
  StartCheck check;
  CheckTls(config, check);
  CheckKeys(config, check);
  CheckFleetKey(config, check);
  const bool is_running = CheckDatabase(config, check);
  CheckRecords(config, check);
  if (!is_running) CheckDoors(config, sockets, check);
  return check;
}

int TellCheck(const StartCheck& check) {
  for (const std::string& note : check.notes) std::printf("dhpmap-server: %s\n", note.c_str());
  for (const std::string& fault : check.faults) std::fprintf(stderr, "dhpmap-server: %s\n", fault.c_str());
  if (!check.faults.empty()) return 2;
  std::printf("dhpmap-server: ready to start\n");
  return 0;
}

}  // namespace dhpmap
