// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace dhpmap::json {

/// RFC 4648 with padding.
void AppendBase64(std::string_view bytes, std::string* out);

/// Both alphabets (+/ and -_), padding optional. Nothing for any other character or an impossible length.
std::optional<std::string> DecodeBase64(std::string_view text);

}  // namespace dhpmap::json
