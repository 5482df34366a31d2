// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_file.h"
#include "server/auth/keys/key_record.h"
#include "storage/auth_tables.h"

namespace dhpmap::auth {

/// Where a server's keys are. Thread-compatible.
class KeySource {
 public:
  virtual ~KeySource() = default;

  /// All keys if they may have changed since the last call that succeeded; else nothing. The first call reads them.
  virtual Result<std::optional<std::vector<KeyRecord>>> ReadIfChanged() = 0;
  /// How long in s the keys that were read last count while they cannot be read again.
  [[nodiscard]] virtual double longest_outage_s() const = 0;
};

/// A key file. It counts as it was last read until it can be read again.
class KeyFileSource final : public KeySource {
 public:
  explicit KeyFileSource(std::string path) : path_(std::move(path)) {}
  /// Errors as in ReadKeyFile.
  Result<std::optional<std::vector<KeyRecord>>> ReadIfChanged() override;
  [[nodiscard]] double longest_outage_s() const override { return std::numeric_limits<double>::infinity(); }

 private:
  const std::string path_;
  FileState state_;  ///< of the file when it was read; empty: it could not be read
};

/// The keys in a database. A server that is cut off from the database learns of no revocation, so its keys count for
/// ten minutes.
class KeyTableSource final : public KeySource {
 public:
  static constexpr double kLongestOutage_s = 600;

  explicit KeyTableSource(std::shared_ptr<AuthTables> tables) : tables_(std::move(tables)) {}
  /// Errors as in ReadKeyTable.
  Result<std::optional<std::vector<KeyRecord>>> ReadIfChanged() override;
  [[nodiscard]] double longest_outage_s() const override { return kLongestOutage_s; }

 private:
  const std::shared_ptr<AuthTables> tables_;
  std::optional<std::int64_t> version_;
};

}  // namespace dhpmap::auth
