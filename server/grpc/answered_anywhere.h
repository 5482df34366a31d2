// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

namespace dhpmap {

/// Whether every server of a fleet answers this request itself, and not only the map's owner: a watch, and a read of
/// the present state with `consistency: EVENTUAL`. For a message of a stream: the same of its query. The function looks
/// at the request's fields, so a new request needs no change here.
bool AnsweredAnywhere(const google::protobuf::Message& request);

}  // namespace dhpmap
