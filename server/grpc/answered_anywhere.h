// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

namespace dhpmap {

/// Whether every server of a fleet answers this request itself, and not the owner of its map alone: a watch, and a read
/// with `consistency: EVENTUAL` of the present state. Of a stream's message: its query. Knows requests by their fields,
/// so new ones need nothing here.
bool AnsweredAnywhere(const google::protobuf::Message& request);

}  // namespace dhpmap
