// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>

namespace dhpmap::rig {

/// Kills servers that bring databases of older schemas up to date, those in tests/unit/storage/released. What the next
/// one makes of it must be what is made of it without a kill. Thread-compatible.
class MigrationKills {
 public:
  /// `directory`: for databases and logs. `complain` hears of what is not so.
  MigrationKills(std::filesystem::path directory, std::uint64_t seed, std::function<void(std::string)> complain)
      : directory_(std::move(directory)), random_(seed), complain_(std::move(complain)) {}

  /// One kill at a random moment between the start of a server and its ready line. Whether it came before the ready
  /// line.
  bool KillOnce();
  /// How many of them came when the server had begun with what takes work, and left some of that to the next one.
  [[nodiscard]] int num_half_done() const { return num_half_done_; }

 private:
  /// What becomes of a database without a kill.
  struct Reference {
    std::string maps;
    double start_s = 0;
    bool is_older = false;  ///< there is something to bring up to date
  };
  const Reference* ReferenceOf(const std::filesystem::path& released);
  /// One that is older than the server; empty, and complained of, if there is none.
  std::filesystem::path Choose();
  std::filesystem::path CopyOf(const std::filesystem::path& released) const;

  const std::filesystem::path directory_;
  std::mt19937_64 random_;
  const std::function<void(std::string)> complain_;
  std::map<std::filesystem::path, Reference> references_;
  int num_half_done_ = 0;
};

}  // namespace dhpmap::rig
