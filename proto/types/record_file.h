// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "dhpmap/v1/record.pb.h"
#include "mapping/base/result.h"

namespace dhpmap {

inline constexpr char kRecordExtension[] = ".dhprec";

/// Size of a record in a file.
std::size_t BytesInFile(const v1::Record& record);

/// Appends records to a new file: see record.proto. Append writes each record to the system before it returns, so a
/// killed process loses none, a crashed machine only the last ones. Thread-compatible.
class RecordWriter {
 public:
  /// Errors of the file system. ALREADY_EXISTS if there is a file at `path`.
  static Result<RecordWriter> Create(const std::string& path);
  RecordWriter(RecordWriter&& other) noexcept;
  RecordWriter& operator=(RecordWriter&&) = delete;
  ~RecordWriter();

  /// After an error the file may end with a torn record, and nothing more can be appended.
  Status Append(const v1::Record& record);

 private:
  explicit RecordWriter(int file) : file_(file) {}
  int file_;
};

/// Reads records; the first is a `start`. Thread-compatible.
class RecordReader {
 public:
  /// NOT_FOUND, or DATA_LOSS if it is no recording.
  static Result<RecordReader> Open(const std::string& path);

  [[nodiscard]] const v1::RecordStart& start() const { return start_; }
  /// Nothing at the end, also before a torn record.
  Result<std::optional<v1::Record>> Next();
  /// After the end: whether there was a torn record.
  [[nodiscard]] bool is_torn() const { return is_torn_; }

 private:
  RecordReader(std::ifstream file, std::uint64_t num_bytes) : file_(std::move(file)), num_bytes_left_(num_bytes) {}

  std::ifstream file_;
  std::uint64_t num_bytes_left_;
  v1::RecordStart start_;
  bool is_torn_ = false;
};

}  // namespace dhpmap
