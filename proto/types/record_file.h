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

/// What a record takes in a file.
std::size_t BytesInFile(const v1::Record& record);

/// Appends records to a new file: see record.proto. Each is handed to the system as a whole before Append returns, so a
/// process that is killed loses none, a machine the last ones. Thread-compatible.
class RecordWriter {
 public:
  /// Errors of the file system, ALREADY_EXISTS included. `path` must not be there.
  static Result<RecordWriter> Create(const std::string& path);
  RecordWriter(RecordWriter&& other) noexcept;
  RecordWriter& operator=(RecordWriter&&) = delete;
  ~RecordWriter();

  /// After an error the end of the file may be torn, and nothing more can be appended.
  Status Append(const v1::Record& record);

 private:
  explicit RecordWriter(int file) : file_(file) {}
  int file_;
};

/// Reads them, the first of which is a `start`. Thread-compatible.
class RecordReader {
 public:
  /// NOT_FOUND, or DATA_LOSS if it is no record of frames.
  static Result<RecordReader> Open(const std::string& path);

  [[nodiscard]] const v1::RecordStart& start() const { return start_; }
  /// Nothing at the end, which may be torn.
  Result<std::optional<v1::Record>> Next();
  /// After the end: a record there was not written as a whole.
  [[nodiscard]] bool is_torn() const { return is_torn_; }

 private:
  RecordReader(std::ifstream file, std::uint64_t num_bytes) : file_(std::move(file)), num_bytes_left_(num_bytes) {}

  std::ifstream file_;
  std::uint64_t num_bytes_left_;
  v1::RecordStart start_;
  bool is_torn_ = false;
};

}  // namespace dhpmap
