// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/named_pair.h"

#include <sys/random.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>

namespace dhpmap::net {
namespace {

constexpr std::string_view kPrefix = "dhpmap-guard-";

/// "dhpmap-guard-0123456789abcdef-c7"; unpredictable.
std::string RandomName(char end, std::uint64_t number) {
  std::uint64_t secret = 0;
  (void)!::getrandom(&secret, sizeof secret, 0);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%016llx-%c%llu", static_cast<unsigned long long>(secret), end,
                static_cast<unsigned long long>(number));
  return std::string(kPrefix) + text.data();
}

bool Name(const Descriptor& socket, const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(&address.sun_path[1], name.data(), name.size());  // after a zero byte: an abstract name
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), size) == 0;
}

}  // namespace

std::optional<NamedPair> MakeNamedPair(std::uint64_t number) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0) return std::nullopt;
  NamedPair pair{.ours = Descriptor(ends[0]), .theirs = Descriptor(ends[1]), .our_name = RandomName('c', number)};
  if (!Name(pair.ours, pair.our_name) || !Name(pair.theirs, RandomName('s', number))) return std::nullopt;
  return pair;
}

std::optional<std::uint64_t> NumberOfPair(std::string_view name) {
  constexpr std::size_t kSecretAndEnd = 16 + 2;
  const std::size_t at = name.find(kPrefix);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view digits = name.substr(std::min(name.size(), at + kPrefix.size() + kSecretAndEnd));
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end == digits.data()) return std::nullopt;
  return number;
}

}  // namespace dhpmap::net
