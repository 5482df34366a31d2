// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// What top, ps and debuggers show of the calling thread: a literal of at most 15 characters.
void NameThisThread(const char* name);

/// Lowers the priority of the calling thread for good, by so many steps of niceness: 10 leave a busy core to others
/// nine times in ten. Threads that it starts are as nice. Needs no rights; to be less nice than the process needs some,
/// and is never asked for. 0 or less changes nothing.
void MakeThisThreadNicer(int by);
/// Whether it was: then others may have its core for long, and whoever is not should not wait for what it does. Knows
/// nothing of niceness that was inherited.
bool IsThisThreadNicer();

/// How long a thread runs before others that wait for its core have their turn.
enum class Turns { kOrdinary, kShort };

/// For the calling thread, and those that it starts afterwards. With kShort it gets a busy core as soon as it has
/// something to do instead of after the turns of others, for a tenth of a millisecond at a time: for what is short and
/// waited for. Over time it gets no more than others. Needs no rights. False where the kernel does not offer it (Linux
/// does from 6.12 on): all turns are ordinary then.
bool TakeTurns(Turns turns);

}  // namespace dhpmap
