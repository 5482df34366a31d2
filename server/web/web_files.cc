// SPDX-License-Identifier: BSD-3-Clause
#include "server/web/web_files.h"

#include <array>
#include <cstdint>
#include <cstring>

// From embedded.S.
extern "C" {
extern const char dhpmap_web_html_begin[], dhpmap_web_html_end[];
extern const char dhpmap_web_css_begin[], dhpmap_web_css_end[];
extern const char dhpmap_web_viewer_begin[], dhpmap_web_viewer_end[];
extern const char dhpmap_web_icon_begin[], dhpmap_web_icon_end[];
}

namespace dhpmap::web {
namespace {

WebFile MakeWebFile(std::string_view name, std::string_view type, const char* begin, const char* end) {
  const std::string_view gzipped(begin, static_cast<std::size_t>(end - begin));
  std::uint32_t size = 0;  // gzip's last four bytes, little-endian
  std::memcpy(&size, begin + gzipped.size() - sizeof size, sizeof size);
  return {name, type, gzipped, size};
}

}  // namespace

std::span<const WebFile> WebFiles() {
  constexpr std::string_view kScript = "text/javascript; charset=utf-8";
  static const std::array<WebFile, 4> files = {
      MakeWebFile("icon.svg", "image/svg+xml", dhpmap_web_icon_begin, dhpmap_web_icon_end),
      MakeWebFile("index.html", "text/html; charset=utf-8", dhpmap_web_html_begin, dhpmap_web_html_end),
      MakeWebFile("viewer.css", "text/css; charset=utf-8", dhpmap_web_css_begin, dhpmap_web_css_end),
      MakeWebFile("viewer.js", kScript, dhpmap_web_viewer_begin, dhpmap_web_viewer_end)};
  return files;
}

}  // namespace dhpmap::web
