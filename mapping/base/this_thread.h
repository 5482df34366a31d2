// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// What top, ps and debuggers show of the calling thread: a literal of at most 15 characters.
void NameThisThread(const char* name);

/// Lowers the priority of the calling thread for good, by so many steps of niceness: 10 leave a busy core to others
/// nine times in ten. Threads that it starts are as nice. Needs no rights; to be less nice than the process needs some,
/// and is never asked for. 0 or less changes nothing.
void MakeThisThreadNicer(int by);

}  // namespace dhpmap
