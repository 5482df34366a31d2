// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Name of the calling thread in top, ps and debuggers: a literal of at most 15 characters.
void NameThisThread(const char* name);

/// Permanently lowers the priority of the calling thread by this many steps of niceness: 10 leave a busy core to others
/// nine times in ten. New threads inherit it. Needs no privileges. 0 or less has no effect.
void MakeThisThreadNicer(int by);
/// Whether MakeThisThreadNicer was called: such a thread may be preempted for long, so threads of normal priority must
/// not wait for it (priority inversion). Ignores inherited niceness.
bool IsThisThreadNicer();

/// Length of a thread's time slices.
enum class Turns { kOrdinary, kShort };

/// For the calling thread and those that it starts later. With kShort it preempts others on a busy core as soon as it
/// has work, for a tenth of a millisecond at a time: for short work that others wait for. Its total share stays the
/// same. Needs no privileges. False if the kernel does not support it (Linux 6.12 and later do).
bool TakeTurns(Turns turns);

}  // namespace dhpmap
