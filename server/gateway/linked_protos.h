// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::gateway {

/// Keeps the linker from dropping the descriptors of our services and of google.rpc's details from the static library.
/// The router finds services in the generated pool, and the JSON form of an Any needs its type there. Add each new
/// .proto file here.
void LinkProtos();

}  // namespace dhpmap::gateway
