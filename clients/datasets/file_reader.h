// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap {

// Readers of whole small files; errors name the file. NOT_FOUND, reason MISSING_FILE, for a missing one.

Result<std::vector<std::byte>> ReadBytes(const std::filesystem::path& path);
/// An image, not decoded; an empty file is INVALID_ARGUMENT, reason BAD_IMAGE.
Result<std::vector<std::byte>> ReadImageFile(const std::filesystem::path& path);
/// The content of a file or pipe; NOT_FOUND, reason MISSING_FILE, on failure.
Result<std::string> ReadText(const std::filesystem::path& path);

/// One line split at commas or, with ' ', at runs of blanks. Cells are trimmed.
struct TextRow {
  int line = 0;  ///< from 1
  std::vector<std::string> cells;
};
/// Skips blank lines and lines that start with '#'.
Result<std::vector<TextRow>> ReadRows(const std::filesystem::path& path, char separator);

/// All numbers of a text file, regardless of line breaks. INVALID_ARGUMENT at the first word that is not a number.
Result<std::vector<double>> ReadNumbers(const std::filesystem::path& path);

/// A pose file: the first 16 numbers as a row-major 4x4 matrix. Errors have reason BAD_POSE.
Result<Eigen::Matrix4d> ReadPose(const std::filesystem::path& path);

// The whole cell must be a number. Accepts "nan" and "inf": poses may contain them, and their users refuse them.
Result<double> ParseNumber(std::string_view cell);
Result<std::int64_t> ParseInteger(std::string_view cell);
/// Decimal seconds to nanoseconds, exact for up to nine decimals.
Result<std::int64_t> ParseSeconds(std::string_view cell);

std::string_view Trim(std::string_view text);
std::string ToLower(std::string text);

/// Subfolders of `directory` whose name starts with `prefix`, by name; none if it cannot be read.
std::vector<std::filesystem::path> FoldersWithPrefix(const std::filesystem::path& directory, std::string_view prefix);

/// Names of files in `directory` that end with `suffix`, without it, sorted; none if it cannot be read.
std::vector<std::string> StemsWithSuffix(const std::filesystem::path& directory, std::string_view suffix);

/// `message` prefixed with the file.
Status BadFile(const std::filesystem::path& path, const std::string& message);

}  // namespace dhpmap
