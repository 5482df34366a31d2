// SPDX-License-Identifier: BSD-3-Clause
// A view as a link: what somebody sees is what the one sees to whom the link is sent.
import { readBox, writeBox } from "./boxes";
import { readPath, writePath } from "./path_text";
import { robotLimits } from "./robot";
import { colourModes, type CameraView, type ColourMode, type ViewState } from "./view";

export type Linked = Pick<
  ViewState,
  | "at"
  | "selected"
  | "query"
  | "hiddenClasses"
  | "hiddenObjects"
  | "showsGone"
  | "colour"
  | "showsBoxes"
  | "theme"
  | "slice_m"
  | "measured_m"
  | "clip"
  | "path"
  | "camera"
> & { readonly mapId: string };

const short = (number: number): string => String(Math.round(number * 1000) / 1000);

function cameraText(camera: CameraView): string {
  const { x, y, z } = camera.position_m;
  return [x, y, z, camera.yaw, camera.pitch].map(short).join(",");
}

function cameraOf(text: string | null): CameraView | null {
  const [x, y, z, yaw, pitch, ...rest] = (text ?? "").split(",").map(Number);
  const numbers = [x, y, z, yaw, pitch];
  if (rest.length > 0 || !numbers.every((number) => number !== undefined && Number.isFinite(number))) return null;
  return { position_m: { x: x ?? 0, y: y ?? 0, z: z ?? 0 }, yaw: yaw ?? 0, pitch: pitch ?? 0 };
}

function heightOf(text: string | null): number | null {
  const height = Number(text ?? "");
  return text && Number.isFinite(height) ? height : null;
}

function revisionOf(text: string | null): number | null {
  const revision = Number(text ?? "");
  return text && Number.isSafeInteger(revision) && revision > 0 ? revision : null;
}

const usualRobot = { radius_m: 0.2, height_m: 0.6 };

/** None where it is nonsense. */
function placesOf(text: string | null): ViewState["path"]["points_m"] {
  try {
    return readPath(text ?? "");
  } catch {
    return []; // as if it were not there
  }
}

function endsOf(text: string | null): ViewState["measured_m"] {
  const ends = placesOf(text);
  return ends.length === 2 ? ends : [];
}


function pathOf(link: URLSearchParams): ViewState["path"] {
  const [radius, height] = (link.get("robot") ?? "").split(",").map(Number);
  const within = (value: number | undefined, [least, most]: readonly [number, number], usual: number) =>
    value !== undefined && value >= least && value <= most ? value : usual;
  return {
    points_m: placesOf(link.get("path")),
    radius_m: within(radius, robotLimits.radius_m, usualRobot.radius_m),
    height_m: within(height, robotLimits.height_m, usualRobot.height_m),
    seenAlone: link.get("seen") === "1",
  };
}

const listText = (items: ReadonlySet<string>): string => [...items].sort().join(",");
const listOf = (text: string): ReadonlySet<string> => new Set(text.split(",").filter((item) => item !== ""));

/** Without the leading "#". What is as it is for everybody at first is left out. */
export function writeLink(view: Linked): string {
  const link = new URLSearchParams();
  if (view.mapId) link.set("map", view.mapId);
  if (view.at !== null) link.set("at", String(view.at));
  if (view.selected !== null) link.set("object", view.selected);
  if (view.query) link.set("find", view.query);
  if (listText(view.hiddenClasses) !== "ceiling") link.set("hide", listText(view.hiddenClasses));
  if (view.hiddenObjects.size > 0) link.set("without", listText(view.hiddenObjects));
  if (view.showsGone) link.set("gone", "1");
  if (view.colour !== "sensor") link.set("colour", view.colour);
  if (view.showsBoxes) link.set("boxes", "1");
  if (view.theme !== "system") link.set("theme", view.theme);
  if (view.slice_m !== null) link.set("slice", short(view.slice_m));
  if (view.measured_m.length === 2) link.set("measure", writePath(view.measured_m, ";"));
  if (view.clip) link.set("clip", writeBox(view.clip));
  if (view.path.points_m.length > 0) {
    link.set("path", writePath(view.path.points_m, ";"));
    link.set("robot", [view.path.radius_m, view.path.height_m].map(short).join(","));
    if (view.path.seenAlone) link.set("seen", "1");
  }
  if (view.camera) link.set("view", cameraText(view.camera));
  return link.toString().replaceAll("%2C", ",");
}

/** What a link says; of anything else in it nothing. */
export function readLink(hash: string): Linked {
  const link = new URLSearchParams(hash.replace(/^#/, ""));
  const colour = link.get("colour");
  const theme = link.get("theme");
  return {
    mapId: link.get("map") ?? "",
    at: revisionOf(link.get("at")),
    selected: link.get("object"),
    query: link.get("find") ?? "",
    hiddenClasses: listOf(link.get("hide") ?? "ceiling"),
    hiddenObjects: listOf(link.get("without") ?? ""),
    showsGone: link.get("gone") === "1",
    colour: colourModes.find((mode): mode is ColourMode => mode === colour) ?? "sensor",
    showsBoxes: link.get("boxes") === "1",
    theme: theme === "dark" || theme === "light" ? theme : "system",
    slice_m: heightOf(link.get("slice")),
    measured_m: endsOf(link.get("measure")),
    clip: readBox(link.get("clip")),
    path: pathOf(link),
    camera: cameraOf(link.get("view")),
  };
}
