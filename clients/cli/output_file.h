// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/result.h"

namespace dhpmap {

/// A file that appears only when complete: written under a temporary name next to its place, renamed by Close, removed
/// without Close. "-" is stdout.
class OutputFile {
 public:
  static Result<OutputFile> Open(const std::string& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  void Write(std::string_view data);
  [[nodiscard]] std::int64_t num_bytes() const { return num_bytes_; }
  /// Returns whether everything was written.
  Status Close();

 private:
  explicit OutputFile(std::string path) : path_(std::move(path)) {}
  [[nodiscard]] bool is_stdout() const { return path_ == "-"; }
  [[nodiscard]] std::string partial_path() const { return path_ + ".part"; }

  std::string path_;  // empty once closed or moved from
  std::ofstream file_;
  std::int64_t num_bytes_ = 0;
};

}  // namespace dhpmap
