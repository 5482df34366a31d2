// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/auth/call_limits.h"
#include "server/auth/keys/principal.h"
#include "server/auth/keys/utc_text.h"

namespace dhpmap::auth {

/// One call, as the audit log records it.
struct AuditEntry {
  const Principal* principal = nullptr;  ///< null: unknown caller
  std::string_view rpc;                  ///< "/dhpmap.v1.MapService/DeleteMap"
  std::string map;                       ///< as the request names it; may be empty
  Status decision;                       ///< OK: admitted
};

/// Records admitted calls that change something, and refused calls. Each record is a line of JSON with time, principal,
/// key id, rpc, map and decision; it never contains a key or the content of a request. At most kMostRefusals refusals a
/// second are written for known principals, and as many for unknown callers. The next line states how many were left
/// out. Thread-safe.
class AuditLog {
 public:
  static constexpr int kMostRefusals = 10;

  /// Opens the file for appending; creates it with mode 0600 if it is missing. FAILED_PRECONDITION, reason
  /// BAD_KEY_FILE, for a link, or a file that cannot be written.
  static Result<std::unique_ptr<AuditLog>> Open(const std::string& path, WallClock now_s);
  ~AuditLog();
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;

  /// UNAVAILABLE, reason NOT_STORED, if the line could not be written.
  Status Write(const AuditEntry& entry) DHPMAP_EXCLUDES(mutex_);
  /// Opens the path again after the old file was renamed. Every line goes to exactly one of the files. Errors as of
  /// Open: then it continues in the old file.
  Status Reopen() DHPMAP_EXCLUDES(mutex_);

 private:
  AuditLog(std::string path, int file, WallClock now_s)
      : path_(std::move(path)), now_s_(std::move(now_s)), file_(file) {}

  const std::string path_;
  const WallClock now_s_;
  Mutex mutex_;
  int file_ DHPMAP_GUARDED_BY(mutex_);
  bool ends_within_a_line_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::int64_t second_ DHPMAP_GUARDED_BY(mutex_) = 0;
  int num_refusals_[2] DHPMAP_GUARDED_BY(mutex_) = {};  ///< in that second: of unknown callers, of known principals
  std::int64_t num_left_out_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap::auth
