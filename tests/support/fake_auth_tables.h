// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/auth_tables.h"

namespace dhpmap::testing {

/// Tables in memory, which fail when a test says so. Thread-safe.
class FakeAuthTables final : public AuthTables {
 public:
  /// The answer to every call from now on; OK: as usual.
  void FailWith(const Status& status) {
    const MutexLock lock(mutex_);
    failure_ = status;
  }
  /// Called by WriteKeys before it looks at the version.
  void BeforeWrite(std::function<void()> hook) { before_write_ = std::move(hook); }
  [[nodiscard]] int num_key_reads() const {
    const MutexLock lock(mutex_);
    return num_key_reads_;
  }

  Result<std::int64_t> KeysVersion() override {
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    return version_;
  }
  Result<KeyRows> ReadKeys() override {
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    ++num_key_reads_;
    KeyRows keys{.version = version_};
    for (const auto& [id, record] : keys_) keys.rows.push_back({id, record});
    return keys;
  }
  Status WriteKeys(std::int64_t seen_version, std::span<const KeyRow> changed) override {
    if (before_write_) std::exchange(before_write_, {})();
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    if (seen_version != version_) return {StatusCode::kAborted, "changed meanwhile"};
    for (const KeyRow& row : changed) keys_[row.id] = row.record;
    ++version_;
    return Status::Ok();
  }
  Status AppendAudit(std::span<const AuditRow> rows) override {
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    audit_.insert(audit_.end(), rows.begin(), rows.end());
    return Status::Ok();
  }
  Result<std::vector<AuditRow>> ListAudit(const AuditQuery&) override {
    const MutexLock lock(mutex_);
    return std::vector<AuditRow>(audit_.rbegin(), audit_.rend());
  }
  Status AddMapMaker(std::uint64_t history_id, const std::string& principal) override {
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    makers_[history_id] = principal;
    return Status::Ok();
  }
  Result<std::optional<std::string>> MakerOf(std::uint64_t history_id) override {
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    const auto found = makers_.find(history_id);
    return found != makers_.end() ? std::optional(found->second) : std::nullopt;
  }
  Result<std::vector<std::uint64_t>> MapsMadeBy(const std::string& principal) override {
    const MutexLock lock(mutex_);
    if (!failure_.ok()) return failure_;
    std::vector<std::uint64_t> maps;
    for (const auto& [history_id, maker] : makers_) {
      if (maker == principal) maps.push_back(history_id);
    }
    return maps;
  }

 private:
  mutable Mutex mutex_;
  Status failure_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t version_ DHPMAP_GUARDED_BY(mutex_) = 0;
  int num_key_reads_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::map<std::string, std::string> keys_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<AuditRow> audit_ DHPMAP_GUARDED_BY(mutex_);
  std::map<std::uint64_t, std::string> makers_ DHPMAP_GUARDED_BY(mutex_);
  std::function<void()> before_write_;
};

}  // namespace dhpmap::testing
