// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "dhpmap/v1/edit_service.pb.h"
#include "server/app/edits/edit_undo.h"
#include "server/app/edits/revision_restore.h"
#include "server/app/open_map/open_map.h"
#include "server/wire/paging.h"

namespace dhpmap {

inline constexpr std::size_t kMaxAuthorBytes = 256;

/// Author and id of a request of `method`. INVALID_ARGUMENT for an id that is no UUID, reason BAD_REQUEST_ID, and for
/// an author above kMaxAuthorBytes, reason BAD_AUTHOR.
Result<EditSource> MakeEditSource(std::string_view method, const std::string& author, const std::string& request_id,
                                  const google::protobuf::Message& request);
template <typename Request>
Result<EditSource> EditSourceOf(std::string_view method, const Request& request) {
  return MakeEditSource(method, request.author(), request.request_id(), request);
}

/// Preconditions of an edit; they must not refer to `lost` states.
template <typename Request>
EditConditions ConditionsOf(const Request& request, const std::string& etag, const LostRevisions& lost) {
  return {.etag = etag, .expected_revision = request.expected_revision(), .lost = lost};
}

/// The edits of a page, plus one. INVALID_ARGUMENT for a token of another list.
Result<EditQuery> EditQueryFromProto(const v1::ListEditsRequest& request, const Pager& pager);

/// INVALID_ARGUMENT for a count out of bounds, and for an edit that is malformed or of another map.
Result<UndoRequest> UndoFromProto(const v1::UndoEditsRequest& request, const std::string& map);
Result<UndoRequest> UndoFromProto(const v1::RedoEditsRequest& request, const std::string& map);

/// INVALID_ARGUMENT for a negative expected_revision, and for an object that is malformed or of another map.
Result<RestoreRequest> RestoreFromProto(const v1::RestoreRevisionRequest& request, const std::string& map);

v1::LoggedEdit ToProto(const LoggedEdit& edit, const std::string& map);

}  // namespace dhpmap
