// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_record.h"

namespace dhpmap::auth {

inline constexpr std::size_t kMostKeys = 10'000;

/// Identifies a state of a file, to detect that it was written or replaced.
struct FileState {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t changed_ns = 0;  ///< ctime: of content, owner or mode
  friend bool operator==(const FileState&, const FileState&) = default;
};

struct PrivateFile {
  std::string text;
  FileState state;
};
/// A file with secrets. FAILED_PRECONDITION, reason BAD_KEY_FILE: it is not there, a symbolic link, no plain file, of
/// another user, open to others than its owner (0600), or larger than 16 MiB.
Result<PrivateFile> ReadPrivateFile(const std::string& path);

struct KeyFileContent {
  std::vector<KeyRecord> records;
  FileState state;
};

/// Errors as in ReadPrivateFile, also for a malformed line: then no key is taken.
Result<KeyFileContent> ReadKeyFile(const std::string& path);
/// The state of the file now; errors as in ReadKeyFile.
Result<FileState> StateOfKeyFile(const std::string& path);

/// Changes the file under a lock against other processes (a file of the same name plus ".lock"); creates an empty one
/// if it is missing. Replaces the file atomically, so a crash leaves the old or the new one. Returns errors of
/// `change`, after which the file is unchanged, or errors as in ReadKeyFile.
Status ChangeKeyFile(const std::string& path, const std::function<Status(std::vector<KeyRecord>&)>& change);

}  // namespace dhpmap::auth
