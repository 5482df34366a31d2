// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Metadata of a call from the REST door: the client's stream is a single message, so the answer is a single message or
/// an error.
inline constexpr char kOneMessageKey[] = "dhpmap-one-message";

/// Likewise: the etags of the files that the client has, with commas between them. Of one of these a single message
/// comes, with its etag and without data.
inline constexpr char kHeldEtagsKey[] = "dhpmap-held-etags";

}  // namespace dhpmap
