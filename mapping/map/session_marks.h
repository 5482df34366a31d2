// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

/// How far a session of frames has got in a map. Sessions are named by clients and last over reconnects and restarts.
struct SessionMark {
  std::string session;
  std::int64_t sequence = 0;  ///< the client's number of the last frame that was taken
  std::int64_t time_ns = 0;   ///< when that was, UTC

  friend bool operator==(const SessionMark&, const SessionMark&) = default;
};

/// INVALID_ARGUMENT unless it is 1 to 64 of A-Z a-z 0-9 . _ : -
Status ValidateSessionName(std::string_view session);

/// The marks of a map, at most kMost: the one that was set longest ago goes for a new one. Value type.
class SessionMarks {
 public:
  static constexpr std::size_t kMost = 256;

  SessionMarks() = default;
  /// DATA_LOSS unless they have good names, by ascending name and each once, and are not too many.
  static Result<SessionMarks> Create(std::vector<SessionMark> marks);

  /// Nothing if the session is not known, or no longer.
  [[nodiscard]] std::optional<std::int64_t> LastOf(std::string_view session) const;
  /// Adds the mark, or puts it in place of the session's last one.
  void Set(SessionMark mark);

  /// By ascending name.
  [[nodiscard]] const std::vector<SessionMark>& marks() const { return marks_; }
  friend bool operator==(const SessionMarks&, const SessionMarks&) = default;

 private:
  std::vector<SessionMark> marks_;
};

}  // namespace dhpmap
