// SPDX-License-Identifier: BSD-3-Clause
#include "storage/files/upgrade_copy.h"

#include <sys/stat.h>

#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "storage/files/backup.h"
#include "storage/files/copy_progress.h"
#include "storage/files/synced_file.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".before-v";
constexpr char kTask[] = "see how large a copy would be";

/// The target of a link, so that the copy is on the same disk.
fs::path FileOf(const std::string& path) {
  std::error_code error;
  fs::path file = fs::weakly_canonical(path, error);
  return error ? fs::path(path) : file;
}

fs::path FolderOf(const std::string& path) {
  const fs::path folder = FileOf(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

std::string Mebibytes(std::int64_t bytes) { return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB"; }

/// The schema version of a database without writers; nothing if it is not ours.
std::optional<std::int64_t> SchemaOf(const std::string& file) {
  constexpr char kLook[] = "see of which schema a copy is";
  if (std::error_code error; !fs::is_regular_file(file, error)) return std::nullopt;
  auto database = sqlite::Database::Open(file, sqlite::OpenMode::kReadOnlyImmutable, 0);
  if (!database.ok()) return std::nullopt;
  const auto application = database->QueryInt("PRAGMA application_id", kLook);
  const auto schema = database->QueryInt("PRAGMA user_version", kLook);
  if (!application.ok() || *application != kApplicationId || !schema.ok()) return std::nullopt;
  return *schema;
}

/// The time of its last write; nothing if it is missing or empty.
std::optional<fs::file_time_type> WrittenAt(const std::string& file) {
  std::error_code error;
  if (const auto size = fs::file_size(file, error); error || size == 0) return std::nullopt;
  const auto time = fs::last_write_time(file, error);
  return error ? std::nullopt : std::optional(time);
}

/// Whether the copy was made for an upgrade from schema `from`. An interrupted upgrade has advanced the database, or
/// not yet changed it.
bool IsOfThisUpgrade(const std::string& copy, const std::string& path, std::int64_t from) {
  const auto schema = SchemaOf(copy);
  if (!schema || *schema > from) return false;
  if (*schema < from) return true;
  const auto copied = WrittenAt(copy);
  const auto is_older = [&](const std::string& file) {
    const auto written = WrittenAt(file);
    return !written || *written <= *copied;
  };
  const std::string file = FileOf(path).string();
  return copied && is_older(file) && is_older(file + "-wal");
}

Status CheckRoom(std::int64_t needed_bytes, const std::string& path, const UpgradeCopyOptions& options) {
  const auto free_bytes = options.free_bytes ? options.free_bytes(FolderOf(path).string()) : FreeBytesBeside(path);
  if (!free_bytes.ok()) return free_bytes.status();
  if (*free_bytes >= needed_bytes + kFreeBesideCopy_bytes) return Status::Ok();
  return FailedPrecondition(
      "the database has to be brought up to date, and there is no room to keep a copy of it as it "
      "is: that takes " +
      Mebibytes(needed_bytes) + " and 64 MiB to spare, and " + Mebibytes(*free_bytes) +
      " are free. Make room, or go without (--no-backup)");
}

/// Writes the copy to `place`, completely or not at all.
Status WriteUpgradeCopy(sqlite::Database& database, const std::string& path, const std::string& place,
                        const SchemaProgress& progress) {
  const std::string unfinished = UnfinishedPath(FileOf(path).string());
  Status status;
  {
    const CopyProgress telling(unfinished, progress);
    status = CopyInto(database, unfinished);
  }
  if (status.ok()) status = SyncFile(unfinished);
  if (status.ok()) status = MoveSynced(unfinished, place);
  std::error_code ignored;
  if (!status.ok()) fs::remove(unfinished, ignored);
  return status;
}

}  // namespace

std::string UpgradeCopyPath(const std::string& path, std::int64_t schema) {
  return FileOf(path).string() + std::string(kSuffix) + std::to_string(schema);
}

Result<std::int64_t> UpgradeCopyBytes(sqlite::Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t page_bytes, database.QueryInt("PRAGMA page_size", kTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_pages, database.QueryInt("PRAGMA page_count", kTask));
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_free, database.QueryInt("PRAGMA freelist_count", kTask));
  return page_bytes * (num_pages - num_free);
}

Result<std::int64_t> FreeBytesBeside(const std::string& path) {
  std::error_code error;
  const fs::space_info space = fs::space(FolderOf(path), error);
  if (error) return FailedPrecondition("cannot tell how much room the disk has: " + error.message());
  return static_cast<std::int64_t>(space.available);
}

Status KeepUpgradeCopy(sqlite::Database& database, const std::string& path, const UpgradeCopyOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t from, database.QueryInt("PRAGMA user_version", kTask));
  const std::int64_t to = SchemaVersion();
  if (!options.is_kept || from < 1 || from >= to) return Status::Ok();
  const auto tell = [&](const std::string& message) {
    if (options.progress) options.progress(message);
  };
  const std::string place = UpgradeCopyPath(path, to);
  if (IsOfThisUpgrade(place, path, from)) {
    tell("an upgrade of the database goes on; the copy from before it is " + place);
    return Status::Ok();
  }
  RemoveUnfinishedBackups(FileOf(path).string());
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t needed_bytes, UpgradeCopyBytes(database));
  DHPMAP_RETURN_IF_ERROR(CheckRoom(needed_bytes, path, options));
  tell("the database is brought from schema " + std::to_string(from) + " to " + std::to_string(to) +
       "; first a copy of it is kept, of some " + Mebibytes(needed_bytes));
  DHPMAP_RETURN_IF_ERROR(WriteUpgradeCopy(database, path, place, options.progress));
  tell("the database as it was is kept in " + place);
  return Status::Ok();
}

Status WithWayBack(Status status, const std::string& path) {
  if (status.reason() != "NEWER_SCHEMA") return status;
  const fs::path file = FileOf(path);
  const std::string prefix = file.filename().string() + std::string(kSuffix);
  std::optional<std::int64_t> first;  // the oldest that this version can open
  std::error_code error;
  for (fs::directory_iterator it(FolderOf(path), error), end; !error && it != end; it.increment(error)) {
    const std::string name = it->path().filename().string();
    if (!name.starts_with(prefix)) continue;
    std::int64_t number = 0;
    const char* const last = name.data() + name.size();
    const auto [parsed, bad] = std::from_chars(name.data() + prefix.size(), last, number);
    if (bad != std::errc() || parsed != last || number <= SchemaVersion() || (first && *first <= number)) continue;
    if (const auto schema = SchemaOf(it->path().string()); schema && *schema <= SchemaVersion()) first = number;
  }
  const std::string way = first ? "or go back to the copy that was kept before its upgrade, " + prefix +
                                      std::to_string(*first) + " beside it (docs/operate.md)"
                                : "or a backup from before its upgrade";
  return FailedPrecondition(status.message() + ". Start the version that wrote it, " + way).WithReason("NEWER_SCHEMA");
}

}  // namespace dhpmap
