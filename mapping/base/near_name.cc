// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/near_name.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace dhpmap {
namespace {

constexpr std::size_t kMostNames = 1000, kMostLetters = 40, kLeastBeginning = 3;

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// Of names that it is the beginning of, the one with the fewest letters more is nearest; all are nearer than others.
int Remoteness(const std::string& wrong, const std::string& name) {
  constexpr int kRemote = 1 << 20, kNotTheBeginning = 1 << 10;
  if (name.empty() || name.size() > 2 * kMostLetters) return kRemote;
  const std::string lower = Lower(name);
  if (wrong.size() >= kLeastBeginning && lower.starts_with(wrong)) return static_cast<int>(lower.size() - wrong.size());
  const std::size_t letters = std::max(wrong.size(), lower.size());
  const std::size_t most = std::max<std::size_t>(1, letters / 3);
  if (letters - std::min(wrong.size(), lower.size()) > most) return kRemote;
  const int distance = SpellingDistance(wrong, lower);
  const bool is_near = distance <= static_cast<int>(most) && distance < static_cast<int>(letters);
  return is_near ? kNotTheBeginning + distance : kRemote;
}

}  // namespace

int SpellingDistance(std::string_view a, std::string_view b) {
  const std::string from = Lower(a), to = Lower(b);
  std::vector<int> before_last(to.size() + 1), last(to.size() + 1), now(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1)});
      const bool is_exchanged = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (is_exchanged) now[j] = std::min(now[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, now);
  }
  return last[to.size()];
}

std::string NearestName(std::string_view wrong, std::span<const std::string> names) {
  if (wrong.empty() || wrong.size() > kMostLetters) return {};
  const std::string lower = Lower(wrong);
  const std::string* nearest = nullptr;
  int least = Remoteness(lower, {});
  for (const std::string& name : names.first(std::min(names.size(), kMostNames))) {
    const int remoteness = Remoteness(lower, name);
    if (remoteness < least) nearest = &name, least = remoteness;
  }
  return nearest == nullptr ? std::string() : *nearest;
}

std::string DidYouMean(std::string_view wrong, std::span<const std::string> names) {
  const std::string name = NearestName(wrong, names);
  return name.empty() ? std::string() : "; did you mean '" + name + "'?";
}

}  // namespace dhpmap
