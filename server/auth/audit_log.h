// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/auth/audit_entry.h"
#include "server/auth/call_limits.h"
#include "server/auth/keys/utc_text.h"

namespace dhpmap::auth {

/// Records admitted calls that change something, and refused calls. Each record is a line of JSON with time, principal,
/// key id, rpc, map and decision; it never contains a key or the content of a request. RefusalLimit holds, and the next
/// line states how many were left out. Thread-safe.
class AuditLog {
 public:
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
  RefusalLimit refusals_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth
