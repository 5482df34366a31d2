// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "mapping/base/status.h"
#include "server/auth/keys/principal.h"

namespace dhpmap::auth {

/// One call, as the audit log records it.
struct AuditEntry {
  static constexpr std::size_t kMostTextBytes = 128;  ///< recorded of a text from an unauthenticated client

  const Principal* principal = nullptr;  ///< null: unknown caller
  std::string_view rpc;                  ///< "/dhpmap.v1.MapService/DeleteMap"
  std::string map;                       ///< as the request names it; may be empty
  Status decision;                       ///< OK: admitted

  /// "allowed", or the reason of the refusal.
  [[nodiscard]] std::string Verdict() const {
    return decision.ok() ? "allowed" : std::string(decision.reason().name());
  }
};

/// Limits how many refusals are recorded in a second, of known principals and of unknown callers each, and counts what
/// is left out. Thread-compatible.
class RefusalLimit {
 public:
  static constexpr int kMostRefusals = 10;

  /// Whether to record the entry.
  bool Admit(const AuditEntry& entry, std::int64_t now_s) {
    if (now_s != second_) {
      second_ = now_s;
      num_refusals_[0] = num_refusals_[1] = 0;
    }
    int& num_refusals = num_refusals_[entry.principal != nullptr ? 1 : 0];
    if (entry.decision.ok() || ++num_refusals <= kMostRefusals) return true;
    ++num_left_out_;
    return false;
  }
  /// Entries that were left out since the last call.
  std::int64_t TakeLeftOut() { return std::exchange(num_left_out_, 0); }

 private:
  std::int64_t second_ = 0;
  int num_refusals_[2] = {};  ///< in that second: of unknown callers, of known principals
  std::int64_t num_left_out_ = 0;
};

}  // namespace dhpmap::auth
