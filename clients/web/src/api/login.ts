// SPDX-License-Identifier: BSD-3-Clause
import { ApiError } from "./ask";

/** Shows a key once; from then on the browser shows a cookie, which no script can read. */
export async function logIn(key: string): Promise<void> {
  const headers = { Authorization: `Bearer ${key}` };
  const answer = await fetch("/ui/login", { method: "POST", headers }).catch(() => null);
  if (!answer) throw new ApiError("the server does not answer", 0, "UNREACHABLE");
  if (!answer.ok) throw new ApiError("the server knows no such key", answer.status, "");
}
