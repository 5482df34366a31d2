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

/// What is written of one call.
struct AuditEntry {
  const Principal* principal = nullptr;  ///< null: nobody that is known
  std::string_view rpc;                  ///< "/dhpmap.v1.MapService/DeleteMap"
  std::string map;                       ///< as the request names it; may be empty
  Status decision;                       ///< OK: let in
};

/// Who was let in to what changes something, and who was refused what: a line of JSON each, with the time, the
/// principal, the id of its key, the rpc, the map and the decision; never a key, never what a request holds. Of
/// refusals of known principals ten a second are written, of others as many, and how many were left out is said in the
/// next line. Thread-safe.
class AuditLog {
 public:
  static constexpr int kMostRefusals = 10;

  /// Made with mode 0600 if it is not there, and only ever written at its end. FAILED_PRECONDITION, reason
  /// BAD_KEY_FILE, for a link, or a file that cannot be written.
  static Result<std::unique_ptr<AuditLog>> Open(const std::string& path, WallClock now_s);
  ~AuditLog();
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;

  /// UNAVAILABLE, reason NOT_STORED, if the line could not be written.
  Status Write(const AuditEntry& entry) DHPMAP_EXCLUDES(mutex_);
  /// Writes on in what the path leads to now: the old file has been renamed. No line is lost or goes to both. Errors as
  /// of Open: then it writes on in the old one.
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
  int num_refusals_[2] DHPMAP_GUARDED_BY(mutex_) = {};  ///< in that second, of strangers and of known principals
  std::int64_t num_left_out_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap::auth
