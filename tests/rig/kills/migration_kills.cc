// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/kills/migration_kills.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "tests/e2e/server_process.h"
#include "tests/support/places.h"

namespace dhpmap::rig {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::ServerProcess;

constexpr double kMigrationEnd_s = 30;
constexpr std::chrono::seconds kTimeout{60};
/// As storage/schema tells it.
constexpr std::string_view kUnderWay = "bringing the database up to date";
constexpr std::string_view kReady = "gRPC on ";

std::vector<fs::path> Released() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(testing::SourceDir() / "tests/unit/storage/released")) {
    if (entry.path().extension() == ".sqlite") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The schema of a database that is closed: PRAGMA user_version, at its place in the file.
std::uint32_t SchemaOf(const fs::path& file) {
  constexpr std::streamoff kAt = 60;
  std::array<unsigned char, 4> bytes{};
  std::ifstream in(file, std::ios::binary);
  in.seekg(kAt).read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::uint32_t schema = 0;
  for (const unsigned char byte : bytes) schema = schema << 8 | byte;
  return schema;
}

bool Says(const testing::Process& process, std::string_view text) {
  return (process.Stdout() + process.Stderr()).find(text) != std::string::npos;
}

/// What must be the same with and without a kill; nothing if a server does not answer. Not the histories: the first
/// schemas had none, and each migration draws others.
std::optional<std::string> Describe(const ServerProcess& server) {
  const auto stub = v1::MapService::NewStub(server.Connect());
  const auto deadline = std::chrono::system_clock::now() + kTimeout;
  v1::ListMapsResponse list;
  {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    if (!stub->ListMaps(&context, {}, &list).ok()) return std::nullopt;
  }
  std::string text;
  for (const v1::Map& map : list.maps()) {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    v1::VerifyMapRequest request;
    request.set_name(map.name());
    v1::VerifyMapResponse verified;
    if (!stub->VerifyMap(&context, request, &verified).ok()) return std::nullopt;
    text += map.name() + " frames " + std::to_string(map.num_frames()) + " " + verified.ShortDebugString() + "\n";
  }
  return text;
}

}  // namespace

fs::path MigrationKills::CopyOf(const fs::path& released) const {
  fs::path copy = directory_ / "migrated.db";
  for (const char* suffix : {"", "-wal", "-shm", "-lock"}) fs::remove(copy.string() + suffix);
  fs::copy_file(released, copy);
  fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
  return copy;
}

const MigrationKills::Reference* MigrationKills::ReferenceOf(const fs::path& released) {
  const auto known = references_.find(released);
  if (known != references_.end()) return &known->second;
  const fs::path copy = CopyOf(released);
  const auto start = Clock::now();
  ServerProcess server(directory_, copy);
  const double start_s = std::chrono::duration<double>(Clock::now() - start).count();
  const auto maps = server.is_serving() ? Describe(server) : std::nullopt;
  if (!maps || maps->empty() || server.Terminate() != 0) {
    complain_("migration: " + released.filename().string() +
              " is not brought up to date: " + server.process().Stderr());
    return nullptr;
  }
  if (maps->find("faults") != std::string::npos) {
    complain_("migration: " + released.filename().string() + " has faults: " + *maps);
  }
  return &references_
              .emplace(released,
                       Reference{.maps = *maps, .start_s = start_s, .is_older = SchemaOf(released) < SchemaOf(copy)})
              .first->second;
}

fs::path MigrationKills::Choose() {
  for (std::vector<fs::path> files = Released(); !files.empty();) {
    const auto chosen = files.begin() + static_cast<std::ptrdiff_t>(random_() % files.size());
    const Reference* reference = ReferenceOf(*chosen);
    if (reference == nullptr) return {};
    if (reference->is_older) return *chosen;
    files.erase(chosen);
  }
  complain_("migration: there is no database of an older schema");
  return {};
}

bool MigrationKills::KillOnce() {
  const fs::path file = Choose();
  if (file.empty()) return false;
  const Reference* reference = ReferenceOf(file);
  const fs::path copy = CopyOf(file);
  bool is_ready = false, has_begun = false;
  {
    testing::Process server(directory_, {testing::Program("dhpmap-server"), "--db", copy.string(), "--grpc",
                                         "127.0.0.1:0", "--http", "127.0.0.1:0"});
    const double after_s = std::uniform_real_distribution<double>(0, reference->start_s)(random_);
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    if (const auto exit_code = server.Wait(0)) complain_("migration: the server ended by itself: " + server.Stderr());
    server.Signal(SIGKILL);
    server.Wait(kMigrationEnd_s);
    is_ready = Says(server, kReady);
    has_begun = Says(server, kUnderWay);
  }
  ServerProcess next(directory_, copy);
  const auto maps = next.is_serving() ? Describe(next) : std::nullopt;
  if (!maps) {
    complain_("migration: after a kill " + file.filename().string() + " is not served: " + next.process().Stderr());
    return !is_ready;
  }
  if (*maps != reference->maps) {
    complain_("migration: after a kill " + file.filename().string() + " holds\n" + *maps + "not\n" + reference->maps);
  }
  num_half_done_ += has_begun && Says(next.process(), kUnderWay) ? 1 : 0;
  if (next.Terminate() != 0) complain_("migration: a server does not end well: " + next.process().Stderr());
  return !is_ready;
}

}  // namespace dhpmap::rig
