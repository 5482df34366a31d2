// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

namespace dhpmap::testing {

/// The threads of this process, by the kernel's numbers. One that was joined may be among them for a moment longer.
inline std::set<std::string> ThreadIds() {
  std::set<std::string> ids;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    ids.insert(task.path().filename().string());
  }
  return ids;
}

/// How many there are that were not there `before`: those that have ended meanwhile make no difference.
inline std::size_t NumThreadsSince(const std::set<std::string>& before) {
  const std::set<std::string> now = ThreadIds();
  return static_cast<std::size_t>(std::ranges::count_if(now, [&](const auto& id) { return !before.contains(id); }));
}

}  // namespace dhpmap::testing
