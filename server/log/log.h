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
  /// The journal of systemd reads it: lines begin with their priority, "<6>", and no time, which it notes itself.
  bool is_journal = false;
};

/// "debug", "info", "warning", "error" or "off"; INVALID_ARGUMENT otherwise.
Result<LogLevel> LogLevelFromName(std::string_view name);

/// Sends the log to standard error. To be called once, before threads start; until then lines go out at level info.
void InitLog(const LogOptions& options);

/// From the next line on. Thread-safe.
void SetLogLevel(LogLevel level);

/// Whether standard error is the stream to the journal that JOURNAL_STREAM ("device:inode") is about.
bool IsJournal(const std::string& journal_stream);

// One line each, thread-safe. An error is logged once: where it stops travelling.
void LogDebug(std::string_view message);
void LogInfo(std::string_view message);
void LogWarning(std::string_view message);
void LogError(std::string_view message);

}  // namespace dhpmap
