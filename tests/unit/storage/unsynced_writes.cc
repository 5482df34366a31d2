// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/unsynced_writes.h"

#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <random>

namespace dhpmap::testing {
namespace {

struct stat StatOf(int file) {
  struct stat attributes {};
  (void)fstat(file, &attributes);
  return attributes;
}

// Not the C library's, which disk_fault_test.cc replaces.
void WriteNow(int file, const char* bytes, std::size_t size, long offset) {
  (void)!syscall(SYS_pwrite64, file, bytes, size, offset);
}

}  // namespace

void UnsyncedWrites::NoteWrite(int file, std::size_t size, long offset) {
  const struct stat attributes = StatOf(file);
  constexpr long kSector = kSectorBytes;
  const long begin = offset / kSector * kSector, end = offset + static_cast<long>(size);
  for (long sector = begin; sector < end; sector += kSector) {
    Entry entry{file, attributes.st_ino, std::max(sector, offset), -1, {}};
    const long sector_end = std::min(sector + kSector, end);
    entry.before.resize(static_cast<std::size_t>(sector_end - entry.offset));
    (void)!pread(file, entry.before.data(), entry.before.size(), entry.offset);  // zeros beyond the end
    if (sector_end > attributes.st_size) entry.length = std::max<long>(attributes.st_size, entry.offset);
    entries_.push_back(std::move(entry));
  }
}

void UnsyncedWrites::NoteTruncation(int file) {
  const struct stat attributes = StatOf(file);
  entries_.push_back({file, attributes.st_ino, 0, attributes.st_size, {}});
}

void UnsyncedWrites::NoteSync(int file) {
  const std::uint64_t inode = StatOf(file).st_ino;
  std::erase_if(entries_, [inode](const Entry& entry) { return entry.inode == inode; });
}

void UnsyncedWrites::LosePower(std::uint32_t seed) {
  std::mt19937 random(seed);
  for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
    const auto fate = random() % 3;
    if (fate == 0) continue;
    if (fate == 1 && entry->length >= 0) {
      (void)!syscall(SYS_ftruncate, entry->file, entry->length);
      continue;
    }
    if (fate == 2) {
      for (char& byte : entry->before) byte = static_cast<char>(random());
    }
    WriteNow(entry->file, entry->before.data(), entry->before.size(), entry->offset);
  }
}

}  // namespace dhpmap::testing
