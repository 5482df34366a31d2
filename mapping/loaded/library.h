// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/result.h"

namespace dhpmap {

// PCL brings some 60 shared libraries along, needed or not; so it is linked by a library of ours, which is loaded when
// it is first needed, and stays.

/// What `symbol` of our library `file`, such as "libdhpmap_pcl.so", is. It is looked for beside the program and in
/// the folders ../bin and ../lib/dhpmap from there. UNAVAILABLE if it cannot be loaded (it is not there, or no memory
/// or file descriptors are left), INTERNAL if it lacks the symbol; the next call tries again. Thread-safe.
Result<void*> LoadSymbol(const char* file, const char* symbol);

}  // namespace dhpmap
