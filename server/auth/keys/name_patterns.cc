// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/name_patterns.h"

#include <algorithm>
#include <utility>

namespace dhpmap::auth {
namespace {

/// Whether `name` matches `pattern`, in which each '*' stands for any text. Backtracks to the last '*' only, so the
/// cost is at most the product of both lengths.
bool IsLike(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, after_star = std::string_view::npos, star_end = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      after_star = ++p;
      star_end = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (after_star != std::string_view::npos) {
      p = after_star;
      n = ++star_end;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool IsUsable(std::string_view text) {
  if (text.starts_with('!')) text.remove_prefix(1);
  return !text.empty() && text.size() <= NamePatterns::kMostBytes && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-' || c == '*';
  });
}

}  // namespace

NamePatterns NamePatterns::All() { return NamePatterns({"*"}); }

Result<NamePatterns> NamePatterns::Make(std::vector<std::string> texts) {
  if (texts.empty() || texts.size() > kMostPatterns) {
    return InvalidArgument("a key has 1 to " + std::to_string(kMostPatterns) + " patterns").WithReason("BAD_KEY");
  }
  for (const std::string& text : texts) {
    if (IsUsable(text)) continue;
    return InvalidArgument("'" + text.substr(0, 64) + "' is no pattern: letters, digits, . _ - and *, with ! before it")
        .WithReason("BAD_KEY");
  }
  return NamePatterns(std::move(texts));
}

bool NamePatterns::Match(std::string_view name) const {
  bool is_in = false;
  for (const std::string& text : texts_) {
    const bool leaves_out = text.starts_with('!');
    if (!IsLike(std::string_view(text).substr(leaves_out ? 1 : 0), name)) continue;
    if (leaves_out) return false;
    is_in = true;
  }
  return is_in;
}

bool NamePatterns::match_all() const {
  const auto leaves_out = [](const std::string& text) { return text.starts_with('!'); };
  return std::find(texts_.begin(), texts_.end(), "*") != texts_.end() &&
         std::none_of(texts_.begin(), texts_.end(), leaves_out);
}

}  // namespace dhpmap::auth
