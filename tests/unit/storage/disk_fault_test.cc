// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/disk_fault.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>

namespace dhpmap::testing {
namespace {

using Kind = DiskFault::Kind;

// A fault strikes the call that counts `remaining` down to 0.
std::atomic<bool> armed = false;
std::atomic<Kind> armed_kind = Kind::kFull;
std::atomic<int> remaining = 0;

bool Strikes(bool counts) { return armed && counts && remaining.fetch_sub(1) == 1; }

bool StrikesWrite() { return Strikes(armed_kind != Kind::kNoSync); }
bool StrikesSync() { return Strikes(armed_kind == Kind::kNoSync || armed_kind == Kind::kKill); }
bool StrikesTruncation() { return Strikes(armed_kind == Kind::kKill); }

void DieIfKill() {
  if (armed_kind == Kind::kKill) kill(getpid(), SIGKILL);
}

long FailWrite(int file, const void* bytes, std::size_t size, long offset) {
  if (armed_kind != Kind::kFull) (void)!syscall(SYS_pwrite64, file, bytes, size / 2, offset);
  DieIfKill();
  errno = armed_kind == Kind::kFull ? ENOSPC : EIO;
  return -1;
}

}  // namespace

DiskFault::DiskFault(Kind kind, int nth) {
  armed_kind = kind;
  remaining = nth;
  armed = true;
}

DiskFault::~DiskFault() { armed = false; }

bool DiskFault::has_struck() const { return remaining <= 0; }

}  // namespace dhpmap::testing

// In place of the C library's, for SQLite too: symbols of the program come before those of shared libraries.

extern "C" long pwrite64(int file, const void* bytes, std::size_t size, long offset) {
  if (dhpmap::testing::StrikesWrite()) return dhpmap::testing::FailWrite(file, bytes, size, offset);
  return syscall(SYS_pwrite64, file, bytes, size, offset);
}

extern "C" int fdatasync(int file) {
  if (!dhpmap::testing::StrikesSync()) return static_cast<int>(syscall(SYS_fdatasync, file));
  dhpmap::testing::DieIfKill();
  errno = EIO;
  return -1;
}

extern "C" int ftruncate64(int file, long size) {
  if (dhpmap::testing::StrikesTruncation()) dhpmap::testing::DieIfKill();
  return static_cast<int>(syscall(SYS_ftruncate, file, size));
}

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

}  // namespace
}  // namespace dhpmap::testing
