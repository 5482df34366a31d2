// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap::testing {

/// While it lives, one of this process's calls that write to files or sync them goes wrong, and those after it work
/// again. One at a time; the definitions of those calls are in disk_fault_test.cc.
class DiskFault {
 public:
  enum class Kind {
    kFull,      ///< the nth write fails with ENOSPC
    kBroken,    ///< the nth write fails with EIO, half of it done
    kShort,     ///< the nth write does half of it and says so
    kNoSync,    ///< the nth sync fails with EIO
    kKill,      ///< the process is killed in the nth write, truncation or sync; of a write, half is done
    kPowerCut,  ///< as kKill; of what was written since it began and not synced, each sector is kept, as it was before,
                ///< or garbage, and each file that was cut or grew has that length or the one before
  };
  /// `seed`: of what becomes of sectors.
  DiskFault(Kind kind, int nth, std::uint32_t seed = 1);
  ~DiskFault();
  DiskFault(const DiskFault&) = delete;
  DiskFault& operator=(const DiskFault&) = delete;

  [[nodiscard]] bool has_struck() const;
};

}  // namespace dhpmap::testing
