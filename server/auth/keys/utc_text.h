// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace dhpmap::auth {

/// The time in s since 1970, UTC. Injected, so that tests control it.
using WallClock = std::function<std::int64_t()>;
WallClock SystemWallClock();

/// "2026-11-30T12:00:00Z".
std::string UtcText(std::int64_t time_s);
/// Nothing if the text has another form.
std::optional<std::int64_t> UtcFromText(std::string_view text);

/// "90d", "24h", "15m", "30s" -> s, at most 100 years. Nothing if the text has another form.
std::optional<std::int64_t> DurationFromText(std::string_view text);

}  // namespace dhpmap::auth
