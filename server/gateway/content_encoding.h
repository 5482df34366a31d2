// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace dhpmap::gateway {

/// Whether an Accept-Encoding header allows gzip. A missing header, as FindHeader returns it, does not.
bool TakesGzip(std::string_view accept_encoding);

/// Whether a file of this type becomes much smaller: meshes do; databases are compressed already.
bool IsWorthGzip(std::string_view content_type);

/// The etag of a variant: strong etags identify bytes, so the compressed variant has its own. "" stays "".
std::string EtagOfVariant(std::string_view etag, bool is_gzip);

/// Whether an If-None-Match header matches the etag (without quotes; "" never matches). Weak and strong tags count
/// alike (RFC 9110); "*" matches any.
bool IsEtagNamed(std::string_view if_none_match, std::string_view etag);

/// The etags that an If-None-Match header lists for a variant, in their uncompressed form, separated by commas: the
/// first ones, in at most 1,024 bytes. Leaves out what cannot be an etag of this server.
std::string EtagsNamed(std::string_view if_none_match, bool is_gzip);

/// Compresses a file as a stream, for speed rather than size. Thread-compatible.
class GzipStream {
 public:
  GzipStream();
  ~GzipStream();
  GzipStream(GzipStream&&) noexcept;
  GzipStream& operator=(GzipStream&&) noexcept;

  /// Returns what is ready after `data`; may be empty.
  std::string Add(std::string_view data);
  /// Returns the rest. Add must not be called afterwards.
  std::string End();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Decompresses a gzip file, for small and complete ones.
std::string Gunzip(std::string_view gzipped, std::size_t size);

}  // namespace dhpmap::gateway
