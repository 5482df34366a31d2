// SPDX-License-Identifier: BSD-3-Clause
// What one pastes into a terminal or a script to get what the viewer shows.
import { urlOfObject } from "../api/maps";

export const curlOf = (name: string): string => `curl -s '${urlOfObject(name)}'`;

/** Where the server talks gRPC unless it was told otherwise. */
const usualPort = 50051;

export function pythonOf(name: string): string {
  const [, map, , id] = name.split("/");
  return [
    "import dhpmap",
    `m = dhpmap.connect("${location.hostname}:${usualPort}")["${map}"]  # the server's gRPC address`,
    `thing = m.objects[${id}]`,
    "print(thing, thing.center_m, thing.T_map_object)",
  ].join("\n");
}

/** False where the browser does not let the page. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
