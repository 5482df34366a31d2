// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace dhpmap::gateway {

/// Whether an Accept-Encoding header allows gzip. None, as FindHeader tells it, does not.
bool TakesGzip(std::string_view accept_encoding);

/// Whether a file of that type becomes much smaller: meshes do, databases are compressed already.
bool IsWorthGzip(std::string_view content_type);

/// A strong etag is that of the bytes sent: compressed ones have their own. "" stays "".
std::string EtagOfVariant(std::string_view etag, bool is_gzip);

/// Whether an If-None-Match header names the etag, which comes without its quotes; "" is never named. Weak and strong
/// tags count alike, as RFC 9110 has it; "*" names any.
bool IsEtagNamed(std::string_view if_none_match, std::string_view etag);

/// The etags that an If-None-Match header names of a variant, as they are without it, with commas between them: the
/// first ones, in at most 1,024 bytes. What cannot be an etag of ours is left out.
std::string EtagsNamed(std::string_view if_none_match, bool is_gzip);

/// Compresses a file as it comes, quickly rather than well. Thread-compatible.
class GzipStream {
 public:
  GzipStream();
  ~GzipStream();
  GzipStream(GzipStream&&) noexcept;
  GzipStream& operator=(GzipStream&&) noexcept;

  /// What is ready after `data`; may be nothing yet.
  std::string Add(std::string_view data);
  /// The rest. Nothing is added after it.
  std::string End();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The file that GzipStream or gzip made; for what is small and known to be whole.
std::string Gunzip(std::string_view gzipped, std::size_t size);

}  // namespace dhpmap::gateway
