// SPDX-License-Identifier: BSD-3-Clause
// A request, and what may be answered in its place.
import { asJson, asList, asText } from "./read";

/** What the server, or the way to it, answered in place of what was asked. */
export class ApiError extends Error {
  constructor(
    message: string,
    readonly status: number,
    readonly reason: string,
  ) {
    super(message);
  }
  /** Somebody else was there first. */
  get isConflict(): boolean {
    return this.status === 409;
  }
  get isLost(): boolean {
    return this.status === 0;
  }
}

export const base = "/v1/";

export async function ask(path: string, init: RequestInit = {}): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(base + path, init);
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new ApiError("the server does not answer", 0, "UNREACHABLE");
  }
  if (response.ok) return response;
  const body = asJson(await response.json().catch(() => null));
  const reason = asText(asJson(asList(body["details"])[0])["reason"]);
  throw new ApiError(asText(body["message"]) || `the server answered ${response.status}`, response.status, reason);
}

export const askJson = async (path: string, init?: RequestInit) => asJson(await (await ask(path, init)).json());
export const post = (path: string, body: object) =>
  askJson(path, { method: "POST", body: JSON.stringify(body), headers: { "Content-Type": "application/json" } });
