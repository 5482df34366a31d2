// SPDX-License-Identifier: BSD-3-Clause
// What one pastes into a terminal or a script to get what the viewer shows.
import { urlOfObject } from "../api/maps";

export const curlOf = (name: string): string => `curl -s '${urlOfObject(name)}'`;

export const pythonOf = (name: string): string =>
  [
    "import json, urllib.request",
    `url = ${JSON.stringify(urlOfObject(name))}`,
    'submap = json.load(urllib.request.urlopen(url))["submap"]',
    'print(submap["display_name"], submap["map_from_submap"]["translation_m"])',
  ].join("\n");

/** False where the browser does not let the page. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
