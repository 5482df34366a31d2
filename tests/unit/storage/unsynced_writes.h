// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dhpmap::testing {

/// What a disk has not promised to keep yet: the content before of each sector that was written and not synced. Files
/// are known by an open descriptor, and told apart by inode.
class UnsyncedWrites {
 public:
  static constexpr std::size_t kSectorBytes = 512;

  /// Before a write.
  void NoteWrite(int file, std::size_t size, long offset);
  /// Before a truncation.
  void NoteTruncation(int file);
  /// After a sync.
  void NoteSync(int file);
  /// Lets each sector be what it is, what it was before, or garbage, and each length that or the one before.
  void LosePower(std::uint32_t seed);
  void Clear() { entries_.clear(); }

 private:
  struct Entry {
    int file = -1;
    std::uint64_t inode = 0;
    long offset = 0;
    long length = -1;  ///< of the file before; of a write, -1 where it did not grow
    std::vector<char> before;
  };
  std::vector<Entry> entries_;
};

}  // namespace dhpmap::testing
