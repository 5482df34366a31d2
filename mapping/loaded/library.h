// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/result.h"

namespace dhpmap {

// PCL depends on some 60 shared libraries. So it is linked into a separate library of ours, which is loaded at its
// first use and stays loaded.

/// The address of `symbol` in our library `file`, such as "libdhpmap_pcl.so". Searches the program's folder, and ../bin
/// and ../lib/dhpmap relative to it. UNAVAILABLE if the library cannot be loaded (it does not exist, or no memory or
/// file descriptors are left), INTERNAL if it lacks the symbol; the next call tries again. Thread-safe.
Result<void*> LoadSymbol(const char* file, const char* symbol);

}  // namespace dhpmap
