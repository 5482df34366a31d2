// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_source.h"

#include "server/auth/keys/key_table.h"

namespace dhpmap::auth {

Result<std::optional<std::vector<KeyRecord>>> KeyFileSource::ReadIfChanged() {
  DHPMAP_ASSIGN_OR_RETURN(const FileState state, StateOfKeyFile(path_));
  if (state == state_) return std::optional<std::vector<KeyRecord>>();
  auto content = ReadKeyFile(path_);
  state_ = content.ok() ? content->state : FileState{};  // a file that cannot be read is tried again
  if (!content.ok()) return content.status();
  return std::optional(std::move(content->records));
}

Result<std::optional<std::vector<KeyRecord>>> KeyTableSource::ReadIfChanged() {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t version, tables_->KeysVersion());
  if (version == version_) return std::optional<std::vector<KeyRecord>>();
  version_.reset();
  DHPMAP_ASSIGN_OR_RETURN(KeyTableContent content, ReadKeyTable(*tables_));
  version_ = content.version;
  return std::optional(std::move(content.records));
}

}  // namespace dhpmap::auth
