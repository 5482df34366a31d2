// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "clients/evaluator/picture.h"

namespace dhpmap::evaluator {

/// Escapes characters with a meaning in HTML, also for attributes in double quotes.
std::string Escaped(std::string_view text);
/// An HTML <table> from a Markdown table, whose columns are aligned as by MarkdownTable.
std::string HtmlOfTable(std::string_view markdown);
/// An <img> with embedded pixels.
std::string InlineImage(const Picture& picture, std::string_view what);
std::string Base64(std::string_view bytes);

}  // namespace dhpmap::evaluator
