// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/map_owners_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

namespace dhpmap::auth {
namespace {

/// A line begins with a newline, so that a truncated line damages only itself.
std::string LineOf(std::uint64_t history_id, const std::string& principal) {
  nlohmann::ordered_json json;
  json["map"] = std::to_string(history_id);
  json["principal"] = principal;
  std::string line = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  line.insert(line.begin(), '\n');
  return line;
}

void ReadLine(const std::string& line, std::map<std::uint64_t, std::string>& owners) {
  const auto json = nlohmann::json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return;
  const auto map = json.find("map"), principal = json.find("principal");
  if (map == json.end() || principal == json.end() || !map->is_string() || !principal->is_string()) return;
  const auto& digits = map->get_ref<const std::string&>();
  std::uint64_t history_id = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), history_id);
  if (error == std::errc() && end == digits.data() + digits.size()) owners[history_id] = principal->get<std::string>();
}

std::map<std::uint64_t, std::string> ReadAll(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return {};  // reading a device may never end
  std::string text;
  std::array<char, 65'536> part;
  for (ssize_t got = 0; (got = read(file, part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(got));
  }
  std::map<std::uint64_t, std::string> owners;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (end > at) ReadLine(text.substr(at, end - at), owners);
    at = end + 1;
  }
  return owners;
}

Status CannotBeWritten() { return Unavailable("the file of maps' owners cannot be written").WithReason("NOT_STORED"); }

/// Not synced: the entry survives a killed process, not a power cut. That costs one count and no map.
Status Append(int file, const std::string& text) {
  const bool is_written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  return is_written ? Status::Ok() : CannotBeWritten();
}

}  // namespace

Result<std::unique_ptr<MapOwnersFile>> MapOwnersFile::Open(const std::string& path) {
  if (path.empty()) return std::unique_ptr<MapOwnersFile>(new MapOwnersFile({}, -1, {}));
  const int file = open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
  if (file < 0) {
    return FailedPrecondition("the file of maps' owners " + path + " cannot be opened: " + std::strerror(errno))
        .WithReason("BAD_KEY_FILE");
  }
  return std::unique_ptr<MapOwnersFile>(new MapOwnersFile(path, file, ReadAll(file)));
}

MapOwnersFile::~MapOwnersFile() {
  if (file_ >= 0) close(file_);
}

Status MapOwnersFile::Add(std::uint64_t history_id, const std::string& principal) {
  const MutexLock lock(mutex_);
  owners_[history_id] = principal;
  return file_ < 0 ? Status::Ok() : Append(file_, LineOf(history_id, principal));
}

Result<std::optional<std::string>> MapOwnersFile::OwnerOf(std::uint64_t history_id) const {
  const MutexLock lock(mutex_);
  const auto found = owners_.find(history_id);
  return found != owners_.end() ? std::optional(found->second) : std::nullopt;
}

Status MapOwnersFile::Keep(const std::set<std::uint64_t>& history_ids) {
  const MutexLock lock(mutex_);
  std::string text;
  std::erase_if(owners_, [&](const auto& owner) { return !history_ids.contains(owner.first); });
  for (const auto& [history_id, principal] : owners_) text += LineOf(history_id, principal);
  if (file_ < 0) return Status::Ok();
  const std::string beside = path_ + ".new";
  const int file = open(beside.c_str(), O_RDWR | O_APPEND | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file < 0) return CannotBeWritten();
  const Status written = Append(file, text);
  if (!written.ok() || fdatasync(file) != 0 || rename(beside.c_str(), path_.c_str()) != 0) {
    close(file);
    return CannotBeWritten();
  }
  close(std::exchange(file_, file));
  return Status::Ok();
}

std::size_t MapOwnersFile::size() const {
  const MutexLock lock(mutex_);
  return owners_.size();
}

Result<std::set<std::uint64_t>> MapOwnersFile::MapsOf(const std::string& principal) const {
  const MutexLock lock(mutex_);
  std::set<std::uint64_t> maps;
  for (const auto& [history_id, owner] : owners_) {
    if (owner == principal) maps.insert(history_id);
  }
  return maps;
}

}  // namespace dhpmap::auth
