// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "mapping/base/result.h"

namespace dhpmap {

enum class LogLevel { kDebug, kInfo, kWarning, kError, kOff };

struct LogOptions {
  LogLevel level = LogLevel::kInfo;
  bool json_lines = false;  ///< one JSON object a line: time, level, message
  /// For systemd's journal: lines begin with their priority, "<6>", and have no time, because the journal adds it.
  bool is_journal = false;
};

/// "debug", "info", "warning", "error" or "off"; INVALID_ARGUMENT otherwise.
Result<LogLevel> LogLevelFromName(std::string_view name);

/// Sends the log to standard error. Call once, before threads start; until then lines are written at level info.
void InitLog(const LogOptions& options);

/// Takes effect with the next line. Thread-safe.
void SetLogLevel(LogLevel level);

/// Whether standard error is the journal stream that JOURNAL_STREAM ("device:inode") names.
bool IsJournal(const std::string& journal_stream);

// One line each, thread-safe. Log an error once, where it is handled.
void LogDebug(std::string_view message);
void LogInfo(std::string_view message);
void LogWarning(std::string_view message);
void LogError(std::string_view message);

}  // namespace dhpmap
