// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace dhpmap {

/// The end of a relayed call whose client has cancelled it: the client does not read it.
inline Status ClientIsGone() { return Cancelled("the client went away"); }

}  // namespace dhpmap
