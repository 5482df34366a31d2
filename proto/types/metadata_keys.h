// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Metadata of a call by which the REST door says that the client's stream is one message: then its answer is one
/// message, too, or the error that refuses it.
inline constexpr char kOneMessageKey[] = "dhpmap-one-message";

}  // namespace dhpmap
