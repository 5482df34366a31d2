// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace dhpmap::web {

/// A file of the viewer (clients/web/dist), embedded in the program, compressed. Views are always valid.
struct WebFile {
  std::string_view name;  ///< "index.html"
  std::string_view type;  ///< its Content-Type
  std::string_view gzipped;
  std::size_t size = 0;  ///< before compression
};

/// All files, sorted by name. Thread-safe.
std::span<const WebFile> WebFiles();

}  // namespace dhpmap::web
