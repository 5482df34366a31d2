// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace dhpmap {

/// The text as it stands between the quotes of a JSON string; control characters as \uXXXX, so it stays on one line.
std::string EscapeForJson(std::string_view text);

}  // namespace dhpmap
