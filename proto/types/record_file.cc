// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/record_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>

namespace dhpmap {
namespace {

constexpr std::string_view kMagic = "DHPMREC1";
constexpr std::size_t kHeadBytes = 8;

std::uint32_t ChecksumOf(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void PutU32(std::uint32_t value, char* bytes) {
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<char>(value >> (8 * i));
}

std::uint32_t GetU32(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return value;
}

Status WriteAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const StatusCode code =
          errno == ENOSPC || errno == EDQUOT ? StatusCode::kResourceExhausted : StatusCode::kInternal;
      return Status(code, std::string("cannot write the record: ") + std::strerror(errno));
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return Status::Ok();
}

Status NoRecord(const std::string& path) { return DataLoss(path + " is no record of frames"); }

}  // namespace

std::size_t BytesInFile(const v1::Record& record) { return kHeadBytes + record.ByteSizeLong(); }

Result<RecordWriter> RecordWriter::Create(const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) {
    const std::string why = "cannot make " + path + ": " + std::strerror(errno);
    return errno == EEXIST ? AlreadyExists(why) : FailedPrecondition(why);
  }
  RecordWriter writer(file);
  DHPMAP_RETURN_IF_ERROR(WriteAll(file, kMagic));
  return writer;
}

RecordWriter::RecordWriter(RecordWriter&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

RecordWriter::~RecordWriter() {
  if (file_ >= 0) ::close(file_);
}

Status RecordWriter::Append(const v1::Record& record) {
  std::string bytes(kHeadBytes, '\0');
  bytes.reserve(kHeadBytes + record.ByteSizeLong());
  record.AppendToString(&bytes);
  const std::string_view message = std::string_view(bytes).substr(kHeadBytes);
  PutU32(static_cast<std::uint32_t>(message.size()), &bytes[0]);
  PutU32(ChecksumOf(message), &bytes[4]);
  return WriteAll(file_, bytes);
}

Result<RecordReader> RecordReader::Open(const std::string& path) {
  std::error_code error;
  const std::uint64_t num_bytes = std::filesystem::file_size(path, error);
  if (error) return NotFound("cannot read " + path + ": " + error.message());
  std::ifstream file(path, std::ios::binary);
  std::array<char, kMagic.size()> magic{};
  if (!file.read(magic.data(), magic.size()) || std::string_view(magic.data(), magic.size()) != kMagic) {
    return NoRecord(path);
  }
  RecordReader reader(std::move(file), num_bytes - kMagic.size());
  DHPMAP_ASSIGN_OR_RETURN(std::optional<v1::Record> first, reader.Next());
  if (!first || !first->has_start()) return NoRecord(path);
  reader.start_ = std::move(*first->mutable_start());
  return reader;
}

Result<std::optional<v1::Record>> RecordReader::Next() {
  using End = std::optional<v1::Record>;
  if (is_torn_ || num_bytes_left_ == 0) return End();
  is_torn_ = true;  // until it is read
  if (num_bytes_left_ < kHeadBytes) return End();
  std::array<char, kHeadBytes> head{};
  if (!file_.read(head.data(), head.size())) return End();
  const std::uint32_t size = GetU32(head.data());
  if (size > num_bytes_left_ - kHeadBytes || size > std::numeric_limits<std::int32_t>::max()) return End();
  std::string message(size, '\0');
  if (!file_.read(message.data(), size) || ChecksumOf(message) != GetU32(head.data() + 4)) return End();
  v1::Record record;
  if (!record.ParseFromString(message)) return End();
  is_torn_ = false;
  num_bytes_left_ -= kHeadBytes + size;
  return End(std::move(record));
}

}  // namespace dhpmap
