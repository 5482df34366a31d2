// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/ui_link.h"

namespace dhpmap {

std::string HttpOf(std::string_view grpc_address) {
  constexpr std::string_view kPort = ":8080";
  for (const std::string_view scheme : {"dns:///", "dns:", "ipv4:", "ipv6:"}) {
    if (!grpc_address.starts_with(scheme)) continue;
    grpc_address.remove_prefix(scheme.size());
    break;
  }
  std::string host = "127.0.0.1";
  if (!grpc_address.starts_with("unix")) {
    const std::size_t bracket = grpc_address.find(']');
    const std::size_t colon = grpc_address.find(':', bracket == std::string_view::npos ? 0 : bracket);
    if (const std::string_view named = grpc_address.substr(0, colon); !named.empty()) host = named;
  }
  return "http://" + host + std::string(kPort);
}

std::string UiLink(std::string_view http, std::string_view map) {
  constexpr std::string_view kMaps = "maps/";
  while (http.ends_with('/')) http.remove_suffix(1);
  if (map.starts_with(kMaps)) map.remove_prefix(kMaps.size());
  std::string link = http.find("://") == std::string_view::npos ? "http://" : "";
  link.append(http).append("/ui/");
  if (!map.empty()) link.append("#map=").append(map);
  return link;
}

}  // namespace dhpmap
