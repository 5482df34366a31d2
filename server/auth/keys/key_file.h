// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_record.h"

namespace dhpmap::auth {

inline constexpr std::size_t kMostKeys = 10'000;

/// What tells whether a file has been written or replaced.
struct FileState {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t changed_ns = 0;  ///< content, owner or mode
  friend bool operator==(const FileState&, const FileState&) = default;
};

struct KeyFileContent {
  std::vector<KeyRecord> records;
  FileState state;
};

/// FAILED_PRECONDITION, reason BAD_KEY_FILE: it is not there, a symbolic link, no plain file, of another user, open to
/// others than its owner (0600), too large, or has a line that is no key's. All of it is taken or nothing.
Result<KeyFileContent> ReadKeyFile(const std::string& path);
/// Of the file as it is now; errors as of ReadKeyFile.
Result<FileState> StateOfKeyFile(const std::string& path);

/// Makes an empty file if there is none; changes it while no other process does, and puts the new one in place of the
/// old at once: after a crash it is one or the other. The lock is a file of the same name with ".lock" behind it.
/// Errors of `change`, which leave it as it was, or as of ReadKeyFile.
Status ChangeKeyFile(const std::string& path, const std::function<Status(std::vector<KeyRecord>&)>& change);

}  // namespace dhpmap::auth
