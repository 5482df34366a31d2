// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dhpmap::http {

struct Target {
  std::string_view path;   ///< percent-encoded; at least "/"
  std::string_view query;  ///< without the '?'; percent-encoded
};

/// Splits a request target in origin form ("/a?b") or absolute form ("http://host/a?b"). Nothing for other forms.
std::optional<Target> SplitTarget(std::string_view target);

/// Nothing for an invalid escape. With `keep_slash`, "%2F" stays encoded, so that it cannot act as a path separator.
std::optional<std::string> PercentDecode(std::string_view text, bool plus_is_space, bool keep_slash);

using QueryPairs = std::vector<std::pair<std::string, std::string>>;

/// "a=1&b=x%20y" decoded, in order; a name without '=' has an empty value. Nothing for an invalid escape.
std::optional<QueryPairs> ParseQuery(std::string_view query);

}  // namespace dhpmap::http
