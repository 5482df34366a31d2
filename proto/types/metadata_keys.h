// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Metadata of a call from the REST door: the client's stream is a single message, so the answer is a single message or
/// an error.
inline constexpr char kOneMessageKey[] = "dhpmap-one-message";

}  // namespace dhpmap
