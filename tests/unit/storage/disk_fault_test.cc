// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/disk_fault.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <string>

#include "tests/unit/storage/unsynced_writes.h"

namespace dhpmap::testing {
namespace {

using Kind = DiskFault::Kind;

// A fault strikes the call that counts `remaining` down to 0.
std::atomic<bool> armed = false;
std::atomic<Kind> armed_kind = Kind::kFull;
std::atomic<int> remaining = 0;
std::atomic<std::uint32_t> armed_seed = 0;

// Held over a call, so that none is under way when the power goes.
std::mutex unsynced_mutex;
UnsyncedWrites unsynced;

bool Strikes(bool counts) { return armed && counts && remaining.fetch_sub(1) == 1; }

bool StrikesWrite() { return Strikes(armed_kind != Kind::kNoSync); }
bool StrikesSync() {
  return Strikes(armed_kind == Kind::kNoSync || armed_kind == Kind::kKill || armed_kind == Kind::kPowerCut);
}
bool StrikesTruncation() { return Strikes(armed_kind == Kind::kKill || armed_kind == Kind::kPowerCut); }
bool NotesWrites() { return armed && armed_kind == Kind::kPowerCut; }

void DieIfKill() {
  if (armed_kind == Kind::kPowerCut) unsynced.LosePower(armed_seed);
  if (armed_kind == Kind::kKill || armed_kind == Kind::kPowerCut) kill(getpid(), SIGKILL);
}

long FailWrite(int file, const void* bytes, std::size_t size, long offset) {
  long done = 0;
  if (armed_kind != Kind::kFull) done = syscall(SYS_pwrite64, file, bytes, size / 2, offset);
  DieIfKill();
  if (armed_kind == Kind::kShort) return done;
  errno = armed_kind == Kind::kFull ? ENOSPC : EIO;
  return -1;
}

long Write(int file, const void* bytes, std::size_t size, long offset) {
  std::unique_lock<std::mutex> lock(unsynced_mutex, std::defer_lock);
  if (NotesWrites()) {
    lock.lock();
    unsynced.NoteWrite(file, size, offset);
  }
  if (StrikesWrite()) return FailWrite(file, bytes, size, offset);
  return syscall(SYS_pwrite64, file, bytes, size, offset);
}

int Sync(int file) {
  std::unique_lock<std::mutex> lock(unsynced_mutex, std::defer_lock);
  if (NotesWrites()) lock.lock();
  if (StrikesSync()) {
    DieIfKill();
    errno = EIO;
    return -1;
  }
  const auto synced = static_cast<int>(syscall(SYS_fdatasync, file));
  if (lock.owns_lock() && synced == 0) unsynced.NoteSync(file);
  return synced;
}

int Truncate(int file, long size) {
  std::unique_lock<std::mutex> lock(unsynced_mutex, std::defer_lock);
  if (NotesWrites()) {
    lock.lock();
    unsynced.NoteTruncation(file);
  }
  if (StrikesTruncation()) DieIfKill();
  return static_cast<int>(syscall(SYS_ftruncate, file, size));
}

}  // namespace

DiskFault::DiskFault(Kind kind, int nth, std::uint32_t seed) {
  armed_kind = kind;
  remaining = nth;
  armed_seed = seed;
  unsynced.Clear();
  armed = true;
}

DiskFault::~DiskFault() { armed = false; }

bool DiskFault::has_struck() const { return remaining <= 0; }

}  // namespace dhpmap::testing

// In place of the C library's, for SQLite too: symbols of the program come before those of shared libraries.

extern "C" long pwrite64(int file, const void* bytes, std::size_t size, long offset) {
  return dhpmap::testing::Write(file, bytes, size, offset);
}

extern "C" int fdatasync(int file) { return dhpmap::testing::Sync(file); }

extern "C" int ftruncate64(int file, long size) { return dhpmap::testing::Truncate(file, size); }

namespace dhpmap::testing {
namespace {

TEST(DiskFault, StrikesTheNthWriteOnly) {
  char name[] = "/tmp/dhpmap-disk-fault-XXXXXX";
  const int file = mkstemp(name);
  ASSERT_GE(file, 0);
  const DiskFault fault(Kind::kFull, 2);
  EXPECT_EQ(pwrite64(file, "ab", 2, 0), 2);
  EXPECT_FALSE(fault.has_struck());
  EXPECT_EQ(pwrite64(file, "ab", 2, 0), -1);
  EXPECT_EQ(errno, ENOSPC);
  EXPECT_TRUE(fault.has_struck());
  EXPECT_EQ(pwrite64(file, "ab", 2, 0), 2);
  close(file);
  unlink(name);
}

/// What 8 sectors that were written over are after a power cut.
std::string AfterPowerCut(int file, bool is_synced, std::uint32_t seed) {
  const std::string old(4096, 'o'), fresh(4096, 'f');
  EXPECT_EQ(pwrite64(file, old.data(), old.size(), 0), 4096);
  UnsyncedWrites writes;
  writes.NoteWrite(file, fresh.size(), 0);
  EXPECT_EQ(pwrite64(file, fresh.data(), fresh.size(), 0), 4096);
  if (is_synced) writes.NoteSync(file);
  writes.LosePower(seed);
  std::string found(4096, '\0');
  EXPECT_EQ(pread(file, found.data(), found.size(), 0), 4096);
  return found;
}

TEST(UnsyncedWrites, APowerCutKeepsDropsOrSpoilsWholeSectorsAndNothingThatWasSynced) {
  char name[] = "/tmp/dhpmap-disk-fault-XXXXXX";
  const int file = mkstemp(name);
  ASSERT_GE(file, 0);
  EXPECT_EQ(AfterPowerCut(file, true, 1), std::string(4096, 'f'));
  int num_kept = 0, num_dropped = 0, num_spoilt = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const std::string found = AfterPowerCut(file, false, seed);
    for (std::size_t at = 0; at < found.size(); at += UnsyncedWrites::kSectorBytes) {
      const std::string sector = found.substr(at, UnsyncedWrites::kSectorBytes);
      num_kept += sector == std::string(sector.size(), 'f');
      num_dropped += sector == std::string(sector.size(), 'o');
      num_spoilt += sector.find_first_not_of(sector[0]) != std::string::npos;
    }
  }
  EXPECT_EQ(num_kept + num_dropped + num_spoilt, 64);
  EXPECT_GT(std::min({num_kept, num_dropped, num_spoilt}), 8);
  close(file);
  unlink(name);
}

}  // namespace
}  // namespace dhpmap::testing
