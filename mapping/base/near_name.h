// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace dhpmap {

/// Edit distance: missing, additional, different or transposed letters, ignoring ASCII case: 1 for "sofaa" and "sofa",
/// "sfoa" and "sofa".
int SpellingDistance(std::string_view a, std::string_view b);

/// The most likely intended name among `names`: one with that prefix, or with at most a third of its letters different.
/// Ties: the first; empty if none is near. Considers the first 1,000 names and 40 letters only, so it is safe for
/// untrusted input.
std::string NearestName(std::string_view wrong, std::span<const std::string> names);

/// "; did you mean 'sofa'?" for the end of an error message, or an empty string.
std::string DidYouMean(std::string_view wrong, std::span<const std::string> names);

}  // namespace dhpmap
