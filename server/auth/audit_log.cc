// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/audit_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

namespace dhpmap::auth {
namespace {

/// Text from a client may be invalid UTF-8: invalid bytes are replaced.
std::string LineOf(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<int> OpenAtItsEnd(const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
  if (file < 0) {
    return FailedPrecondition("the audit log " + path + " cannot be opened: " + std::strerror(errno))
        .WithReason("BAD_KEY_FILE");
  }
  return file;
}

}  // namespace

Result<std::unique_ptr<AuditLog>> AuditLog::Open(const std::string& path, WallClock now_s) {
  DHPMAP_ASSIGN_OR_RETURN(const int file, OpenAtItsEnd(path));
  return std::unique_ptr<AuditLog>(new AuditLog(path, file, std::move(now_s)));
}

AuditLog::~AuditLog() { close(file_); }

Status AuditLog::Reopen() {
  DHPMAP_ASSIGN_OR_RETURN(const int file, OpenAtItsEnd(path_));
  const MutexLock lock(mutex_);
  close(std::exchange(file_, file));
  ends_within_a_line_ = false;
  return Status::Ok();
}

Status AuditLog::Write(const AuditEntry& entry) {
  const std::int64_t now_s = now_s_();
  const MutexLock lock(mutex_);
  if (!refusals_.Admit(entry, now_s)) return Status::Ok();
  nlohmann::ordered_json json;
  json["time"] = UtcText(now_s);
  if (entry.principal != nullptr) {
    json["principal"] = entry.principal->name;
    json["key"] = entry.principal->key_id;
  }
  json["rpc"] = entry.rpc.substr(0, AuditEntry::kMostTextBytes);
  if (!entry.map.empty()) json["map"] = entry.map.substr(0, AuditEntry::kMostTextBytes);
  json["decision"] = entry.Verdict();
  if (const std::int64_t num = refusals_.TakeLeftOut(); num > 0) json["refusals_left_out"] = num;
  std::string line = LineOf(json);
  if (ends_within_a_line_) line.insert(line.begin(), '\n');
  const ssize_t put = write(file_, line.data(), line.size());
  if (put > 0) ends_within_a_line_ = put < static_cast<ssize_t>(line.size());
  if (put == static_cast<ssize_t>(line.size())) return Status::Ok();
  return Unavailable("the audit log cannot be written").WithReason("NOT_STORED");
}

}  // namespace dhpmap::auth
