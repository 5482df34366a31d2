// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap {

/// Escapes text for the inside of a JSON string; control characters become \uXXXX, so it stays on one line.
std::string EscapeForJson(std::string_view text);

}  // namespace dhpmap
