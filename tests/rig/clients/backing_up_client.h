// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "tests/rig/clients/clients.h"

namespace dhpmap::rig {

/// A backup that was finished before the server died, and what must be in it.
struct FinishedBackup {
  std::filesystem::path file;
  Moment asked = 0, answered = 0;
  std::map<std::string, std::int64_t> num_stored;  ///< frames, by history
};

/// Takes backups one after the other, and keeps the last one that was finished in each life of the server.
class BackingUpClient : public Client {
 public:
  /// `file`: where they go, each in place of the one before.
  BackingUpClient(std::filesystem::path file, std::uint64_t seed, Ledger& ledger)
      : Client(seed, ledger), file_(std::move(file)) {}
  void Run(const Life& life) override;
  /// Of the last life, once.
  std::optional<FinishedBackup> Take() { return std::exchange(finished_, std::nullopt); }

 private:
  bool BackUp(const Life& life, Connection& server);
  /// Whether it came whole, as far as it says.
  bool Receive(grpc::ClientReader<v1::BackupMapsResponse>& stream, const std::filesystem::path& file);

  const std::filesystem::path file_;
  std::optional<FinishedBackup> finished_;
};

}  // namespace dhpmap::rig
