// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/web_pages.h"

#include <array>
#include <cstdio>
#include <string>

#include "server/base/fingerprint.h"
#include "server/gateway/content_encoding.h"
#include "server/gateway/media_type.h"
#include "server/web/web_files.h"

namespace dhpmap::gateway {
namespace {

constexpr std::string_view kRoot = "/ui/", kHtml = "text/html";
constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Browsers ask for HTML; curl sends "*/*".
bool IsBrowser(std::string_view accept) { return accept.find(kHtml) != std::string_view::npos; }

http::Response Redirect() {
  http::Response response;
  response.status = 302;
  response.headers = {{"Location", std::string(kRoot)}, {"Cache-Control", "no-store"}, {"Vary", "Accept"}};
  return response;
}

std::string WebEtag(const web::WebFile& file) {
  std::array<char, 18> text{};
  std::snprintf(text.data(), text.size(), "w%016llx", static_cast<unsigned long long>(Fingerprint(file.gzipped)));
  return text.data();
}

http::Response FileResponse(const web::WebFile& file, const http::RequestHead& head) {
  const bool is_gzip = TakesGzip(http::FindHeader(head.headers, "accept-encoding"));
  const std::string etag = EtagOfVariant(WebEtag(file), is_gzip);
  http::Response response;
  response.headers = {{"Content-Type", std::string(file.type)},
                      {"ETag", '"' + etag + '"'},
                      {"Cache-Control", "no-cache"},
                      {"Vary", "Accept-Encoding"},
                      {"Content-Security-Policy", std::string(kPolicy)},
                      {"Cross-Origin-Opener-Policy", "same-origin"},
                      {"Referrer-Policy", "no-referrer"},
                      {"X-Content-Type-Options", "nosniff"}};
  if (IsEtagNamed(http::FindHeader(head.headers, "if-none-match"), etag)) {
    response.status = 304;
  } else if (is_gzip) {
    response.headers.emplace_back("Content-Encoding", "gzip");
    response.body = file.gzipped;
  } else {
    response.body = Gunzip(file.gzipped, file.size);
  }
  return response;
}

}  // namespace

std::optional<http::Response> WebPage(const http::RequestHead& head, std::string_view path) {
  if (path == "/ui" || (path == "/" && IsBrowser(http::FindHeader(head.headers, "accept")))) return Redirect();
  if (!path.starts_with(kRoot)) return std::nullopt;
  path.remove_prefix(kRoot.size());
  if (path.empty()) path = "index.html";
  for (const web::WebFile& file : web::WebFiles()) {
    if (file.name == path) return FileResponse(file, head);
  }
  return std::nullopt;
}

}  // namespace dhpmap::gateway
