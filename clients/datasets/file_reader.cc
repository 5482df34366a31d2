// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/file_reader.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace dhpmap {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\v\f";

template <typename Number>
Result<Number> ParseWhole(std::string_view cell, const char* what) {
  std::string_view text = Trim(cell);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) {
    return InvalidArgument(std::string("'").append(cell).append("' is not ").append(what));
  }
  return value;
}

std::vector<std::string> SplitAt(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end =
        std::min(separator == ' ' ? line.find_first_of(kBlanks, begin) : line.find(separator, begin), line.size());
    const std::string_view cell = Trim(line.substr(begin, end - begin));
    if (separator != ' ' || !cell.empty()) cells.emplace_back(cell);
    begin = end + 1;
  }
  return cells;
}

/// Calls `visit` for each entry of a folder; none if it is unreadable.
template <typename Visitor>
void ForEachEntry(const std::filesystem::path& directory, Visitor visit) {
  std::error_code error;
  for (std::filesystem::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    visit(*it);
  }
}

}  // namespace

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string ToLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

Status BadFile(const std::filesystem::path& path, const std::string& message) {
  return InvalidArgument(path.string() + ": " + message);
}

Result<std::string> ReadText(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  if (type != std::filesystem::file_type::regular && type != std::filesystem::file_type::fifo) {
    return NotFound("there is no file " + path.string()).WithReason("MISSING_FILE");
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (!in.is_open() || in.bad()) return NotFound("cannot read " + path.string()).WithReason("MISSING_FILE");
  return std::move(text).str();
}

Result<std::vector<std::byte>> ReadBytes(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::string text, ReadText(path));
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return std::vector<std::byte>(begin, begin + text.size());
}

Result<std::vector<std::byte>> ReadImageFile(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, ReadBytes(path));
  if (bytes.empty()) return BadFile(path, "is empty").WithReason("BAD_IMAGE");
  return bytes;
}

Result<std::vector<TextRow>> ReadRows(const std::filesystem::path& path, char separator) {
  DHPMAP_ASSIGN_OR_RETURN(const std::string text, ReadText(path));
  std::vector<TextRow> rows;
  std::istringstream in(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string_view content = Trim(line);
    if (!content.empty() && content.front() != '#') rows.push_back({number, SplitAt(content, separator)});
  }
  return rows;
}

Result<std::vector<double>> ReadNumbers(const std::filesystem::path& path) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<TextRow> rows, ReadRows(path, ' '));
  std::vector<double> numbers;
  for (const TextRow& row : rows) {
    for (const std::string& cell : row.cells) {
      Result<double> number = ParseNumber(cell);
      if (!number.ok()) return BadFile(path, "line " + std::to_string(row.line) + ": " + number.status().message());
      numbers.push_back(*number);
    }
  }
  return numbers;
}

Result<Eigen::Matrix4d> ReadPose(const std::filesystem::path& path) {
  Result<std::vector<double>> numbers = ReadNumbers(path);
  if (!numbers.ok()) {
    const bool is_missing = numbers.status().code() == StatusCode::kNotFound;
    return is_missing ? numbers.status() : Status(numbers.status()).WithReason("BAD_POSE");
  }
  if (numbers->size() < 16) {
    return BadFile(path, "a pose needs 16 numbers, there are " + std::to_string(numbers->size()))
        .WithReason("BAD_POSE");
  }
  return Eigen::Matrix4d(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers->data()));
}

Result<double> ParseNumber(std::string_view cell) { return ParseWhole<double>(cell, "a number"); }
Result<std::int64_t> ParseInteger(std::string_view cell) { return ParseWhole<std::int64_t>(cell, "a whole number"); }

Result<std::int64_t> ParseSeconds(std::string_view cell) {
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  const std::string_view text = Trim(cell);
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  std::string decimals(point == std::string_view::npos ? "" : text.substr(point + 1));
  const auto is_digits = [](std::string_view s) {
    return std::all_of(s.begin(), s.end(), [](unsigned char c) { return std::isdigit(c); });
  };
  if (!whole.empty() && whole.size() <= 10 && is_digits(whole) && decimals.size() <= 9 && is_digits(decimals)) {
    decimals.resize(9, '0');
    return *ParseInteger(whole) * kNsPerSecond + *ParseInteger(decimals);
  }
  DHPMAP_ASSIGN_OR_RETURN(const double seconds, ParseNumber(text));  // handles signs and exponents
  if (!(std::abs(seconds) < 9e9)) {
    return InvalidArgument(std::string("'").append(cell).append("' is not a time in seconds"));
  }
  return std::llround(seconds * kNsPerSecond);
}

std::vector<std::filesystem::path> FoldersWithPrefix(const std::filesystem::path& directory, std::string_view prefix) {
  std::vector<std::filesystem::path> folders;
  ForEachEntry(directory, [&](const std::filesystem::directory_entry& entry) {
    std::error_code ignored;
    if (entry.is_directory(ignored) && entry.path().filename().string().starts_with(prefix)) {
      folders.push_back(entry.path());
    }
  });
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::vector<std::string> StemsWithSuffix(const std::filesystem::path& directory, std::string_view suffix) {
  std::vector<std::string> stems;
  ForEachEntry(directory, [&](const std::filesystem::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(suffix)) stems.push_back(name.substr(0, name.size() - suffix.size()));
  });
  std::sort(stems.begin(), stems.end());
  return stems;
}

}  // namespace dhpmap
