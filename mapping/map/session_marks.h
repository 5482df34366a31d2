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

/// Progress of a feed session in a map. Clients name sessions; they outlast reconnects and restarts.
struct SessionMark {
  std::string session;
  std::int64_t sequence = 0;  ///< the client's number of the last accepted frame
  std::int64_t time_ns = 0;   ///< time of that frame's acceptance, UTC

  friend bool operator==(const SessionMark&, const SessionMark&) = default;
};

/// INVALID_ARGUMENT unless it has 1 to 64 characters of A-Z a-z 0-9 . _ : -
Status ValidateSessionName(std::string_view session);

/// The marks of a map, at most kMost; the least recently set one is replaced. Value type.
class SessionMarks {
 public:
  static constexpr std::size_t kMost = 256;

  SessionMarks() = default;
  /// DATA_LOSS unless names are valid, ascending and unique, and kMost is kept.
  static Result<SessionMarks> Create(std::vector<SessionMark> marks);

  /// Nothing for an unknown or replaced session.
  [[nodiscard]] std::optional<std::int64_t> LastOf(std::string_view session) const;
  /// Adds or replaces the session's mark.
  void Set(SessionMark mark);

  /// By ascending name.
  [[nodiscard]] const std::vector<SessionMark>& marks() const { return marks_; }
  friend bool operator==(const SessionMarks&, const SessionMarks&) = default;

 private:
  std::vector<SessionMark> marks_;
};

}  // namespace dhpmap
