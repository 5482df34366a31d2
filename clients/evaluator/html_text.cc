// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/html_text.h"

#include <cstdint>
#include <sstream>
#include <vector>

namespace dhpmap::evaluator {
namespace {

/// "| a | b |" -> {"a", "b"}.
std::vector<std::string> CellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = line.find('|');
  for (std::size_t end = 0; begin != std::string::npos; begin = end) {
    end = line.find('|', begin + 1);
    if (end == std::string::npos) break;
    const std::string cell = line.substr(begin + 1, end - begin - 1);
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
  }
  return cells;
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      default: escaped += c;
    }
  }
  return escaped;
}

std::string HtmlOfTable(std::string_view markdown) {
  std::istringstream lines{std::string(markdown)};
  std::string line, html = "<div class=\"scroll\"><table>";
  std::vector<bool> is_right;
  std::vector<std::vector<std::string>> rows;
  while (std::getline(lines, line)) rows.push_back(CellsOf(line));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::vector<std::string>& cells = rows[row];
    if (row == 0 && rows.size() > 1) {  // in the rule below the header, ":" at the end means right-aligned
      for (const std::string& rule : rows[1]) is_right.push_back(rule.ends_with(':'));
    }
    if (row == 1) continue;
    html += "<tr>";
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const bool is_number = c < is_right.size() && is_right[c];
      const std::string tag = row == 0 ? "th" : "td";
      html += "<" + tag + (is_number ? " class=\"n\">" : ">") + Escaped(cells[c]) + "</" + tag + ">";
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string Base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
    }
  }
  return text;
}

std::string InlineImage(const Picture& picture, std::string_view what) {
  return "<img alt=\"" + Escaped(what) + "\" width=\"" + std::to_string(picture.width_px) + "\" height=\"" +
         std::to_string(picture.height_px) + "\" src=\"data:image/jpeg;base64," +
         Base64(Encode(picture, PictureFormat::kJpeg)) + "\">";
}

}  // namespace dhpmap::evaluator
