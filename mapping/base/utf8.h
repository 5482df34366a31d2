// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dhpmap {

/// Offset of the first byte that is not part of well-formed UTF-8, or npos.
std::size_t FindInvalidUtf8(std::string_view text);
/// Replaces every such byte by '?', for quotes in error messages.
std::string ToValidUtf8(std::string_view text);

}  // namespace dhpmap
