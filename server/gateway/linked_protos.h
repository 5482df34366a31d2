// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::gateway {

/// Keeps the linker from dropping our services' descriptors, and google.rpc's details, from the static library: the
/// router finds the former in the generated pool, and the JSON form of an Any needs the latter. A new .proto file is
/// added here.
void LinkProtos();

}  // namespace dhpmap::gateway
