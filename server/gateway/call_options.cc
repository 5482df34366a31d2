// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/call_options.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <random>

namespace dhpmap::gateway {
namespace {

constexpr std::string_view kRequestId = "x-request-id";
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kForwarded = {{
    {"authorization", "authorization"},
    {"traceparent", "traceparent"},
    {"tracestate", "tracestate"},
    {"user-agent", "x-user-agent"},  // gRPC reserves user-agent
}};
constexpr double kMaxTimeout_s = 86'400;

bool IsPrintableAscii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7F; });
}

std::string NewRequestId() {
  static const std::uint64_t seed = std::random_device{}() | std::uint64_t{std::random_device{}()} << 32;
  static std::atomic<std::uint64_t> count{0};
  std::array<char, 17> text{};
  // An odd multiplier permutes the 64-bit numbers, so ids of one process never repeat and do not look consecutive.
  const std::uint64_t id = (seed ^ count.fetch_add(1)) * 0x9E3779B97F4A7C15u;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), id, 16).ptr;
  return {text.data(), end};
}

Status BadTimeout(std::string_view header, std::string_view value) {
  return InvalidArgument("header " + std::string(header) + ": '" + std::string(value.substr(0, 32)) + "' is no timeout")
      .WithReason("BAD_TIMEOUT");
}

Result<double> ParseTimeout_s(std::string_view header, std::string_view value, double unit_s) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || !(number >= 0)) return BadTimeout(header, value);
  return std::min(number * unit_s, kMaxTimeout_s);
}

/// Up to 8 digits and a unit: H, M, S, m, u or n.
Result<double> ParseGrpcTimeout_s(std::string_view value) {
  constexpr std::string_view kUnits = "HMSmun";
  constexpr std::array<double, 6> kSeconds = {3600, 60, 1, 1e-3, 1e-6, 1e-9};
  const std::size_t unit = value.empty() ? std::string_view::npos : kUnits.find(value.back());
  if (unit == std::string_view::npos) return BadTimeout("grpc-timeout", value);
  return ParseTimeout_s("grpc-timeout", value.substr(0, value.size() - 1), kSeconds[unit]);
}

}  // namespace

Result<CallOptions> MakeCallOptions(const std::string& rpc_path, const http::Headers& headers) {
  CallOptions options;
  options.rpc_path = rpc_path;
  std::string_view id = http::FindHeader(headers, kRequestId);
  options.metadata.emplace_back(kRequestId, id.empty() ? NewRequestId() : std::string(id));
  for (const auto& [header, key] : kForwarded) {
    if (const auto value = http::FindHeader(headers, header); !value.empty()) options.metadata.emplace_back(key, value);
  }
  for (const auto& [key, value] : options.metadata) {
    if (!IsPrintableAscii(value)) {
      return InvalidArgument("the value of header " + key + " is not printable ASCII").WithReason("BAD_HEADER");
    }
  }
  double timeout_s = -1;
  if (const auto value = http::FindHeader(headers, "x-timeout-s"); !value.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(timeout_s, ParseTimeout_s("X-Timeout-S", value, 1));
  } else if (const auto grpc_value = http::FindHeader(headers, "grpc-timeout"); !grpc_value.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(timeout_s, ParseGrpcTimeout_s(grpc_value));
  }
  if (timeout_s >= 0) {
    options.timeout = std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(timeout_s));
  }
  return options;
}

const std::string& RequestIdOf(const CallOptions& options) { return options.metadata.front().second; }

}  // namespace dhpmap::gateway
