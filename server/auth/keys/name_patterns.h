// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::auth {

/// The names that a key is valid for: those that match a pattern, except those that match a pattern with "!". In a
/// pattern '*' matches any text. Immutable except for assignment.
class NamePatterns {
 public:
  static constexpr std::size_t kMostPatterns = 64, kMostBytes = 256;

  /// Matches nothing.
  NamePatterns() = default;
  /// Matches every name.
  static NamePatterns All();
  /// INVALID_ARGUMENT, reason BAD_KEY, for no pattern, too many or too long ones, or other characters than letters,
  /// digits and ". _ - *".
  static Result<NamePatterns> Make(std::vector<std::string> texts);

  [[nodiscard]] bool Match(std::string_view name) const;
  /// Whether every name matches: one pattern is "*", and none begins with "!".
  [[nodiscard]] bool match_all() const;
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }

  friend bool operator==(const NamePatterns&, const NamePatterns&) = default;

 private:
  explicit NamePatterns(std::vector<std::string> texts) : texts_(std::move(texts)) {}
  std::vector<std::string> texts_;
};

}  // namespace dhpmap::auth
