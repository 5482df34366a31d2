// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/utc_text.h"

#include <array>
#include <charconv>
#include <chrono>
#include <ctime>

namespace dhpmap::auth {
namespace {

constexpr const char* kForm = "%Y-%m-%dT%H:%M:%SZ";
constexpr std::int64_t kMost_s = std::int64_t{100} * 365 * 86'400;

}  // namespace

WallClock SystemWallClock() {
  return [] {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::int64_t{std::chrono::duration_cast<std::chrono::seconds>(now).count()};
  };
}

std::string UtcText(std::int64_t time_s) {
  const std::time_t time = time_s;
  std::tm parts{};
  if (gmtime_r(&time, &parts) == nullptr) return {};
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), kForm, &parts)};
}

std::optional<std::int64_t> UtcFromText(std::string_view text) {
  const std::string ended(text);
  std::tm parts{};
  const char* end = strptime(ended.c_str(), kForm, &parts);
  if (end == nullptr || *end != '\0') return std::nullopt;
  return timegm(&parts);
}

std::optional<std::int64_t> DurationFromText(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end + 1 != text.data() + text.size() || number < 0) return std::nullopt;
  const std::int64_t unit_s = *end == 'd' ? 86'400 : *end == 'h' ? 3600 : *end == 'm' ? 60 : *end == 's' ? 1 : 0;
  if (unit_s == 0 || number > kMost_s / unit_s) return std::nullopt;
  return number * unit_s;
}

}  // namespace dhpmap::auth
