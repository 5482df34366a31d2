// SPDX-License-Identifier: BSD-3-Clause
// All that the viewer knows and shows, in one store.
import type {
  AxisBox,
  Cut,
  IgnoredRegion,
  KeptRevision,
  LoggedEdit,
  MapInfo,
  MapObject,
  MapState,
  NearObject,
  PathAnswer,
  Pose,
  RayAnswer,
  Robot,
  SurfacePoint,
  Vector3,
} from "../api/types";
import { Store } from "./store";

export const colourModes = ["sensor", "class", "object", "confidence", "last seen", "presence"] as const;
export type ColourMode = (typeof colourModes)[number];

/** Where the camera is, in the map frame, and where it looks: turn about the vertical and tilt, in rad. */
export interface CameraView {
  readonly position_m: Vector3;
  readonly yaw: number;
  readonly pitch: number;
}

export interface Toast {
  readonly text: string;
  readonly tone: "plain" | "problem" | "collision";
  readonly undoRevision?: number;
}

/** A ray that was asked for. */
export interface CastRay {
  readonly origin_m: Vector3;
  readonly direction: Vector3;
  readonly answer: RayAnswer | null;
}

/** A place where mapping shall take nothing any more, before it is said so. */
export interface RegionDraft {
  readonly name: string;
  readonly box: AxisBox;
  readonly clears: boolean;
}

export type Tool = "select" | "probe" | "path" | "ray" | "measure" | "region";

export interface Probe {
  readonly point_m: Vector3;
  /** Whose surface was clicked. */
  readonly id: string;
  readonly answer: SurfacePoint | null;
}

/** Where a robot shall go, and as what kind of robot. */
export interface RobotPath {
  readonly points_m: readonly Vector3[];
  readonly radius_m: number;
  readonly height_m: number;
  /** What nobody has seen is in the way. */
  readonly seenAlone: boolean;
}

/** An edit that is looked at before it is made. */
export type Draft =
  | { readonly is: "merge"; readonly id: string; readonly other: string | null }
  | { readonly is: "split"; readonly id: string; readonly cut: Cut };

export type Phase =
  | { readonly is: "connecting" }
  | { readonly is: "no maps" }
  | { readonly is: "no such map"; readonly id: string }
  | { readonly is: "loading"; readonly bytes: number }
  | { readonly is: "ready" }
  | { readonly is: "failed"; readonly why: string }
  /** The server asks for a key. */
  | { readonly is: "locked"; readonly why: string }
  | { readonly is: "no webgl" };

export interface ViewState {
  phase: Phase;
  maps: readonly MapInfo[];
  map: MapInfo | null;
  /** Of what is shown. */
  revision: number;
  /** The past revision that is shown; null: the map as it is, and becomes. */
  at: number | null;
  /** The map as it is, while the past is shown, and its revision. */
  present: ReadonlyMap<string, MapObject>;
  newest: number;
  /** What can be shown, the newest first. */
  kept: readonly KeptRevision[];
  showsTime: boolean;
  link: "live" | "lost" | "off";
  objects: ReadonlyMap<string, MapObject>;
  selected: string | null;
  /** Where an object was clicked, to be selected. */
  clicked: { readonly id: string; readonly point_m: Vector3 } | null;
  hovered: string | null;
  query: string;
  hiddenClasses: ReadonlySet<string>;
  hiddenObjects: ReadonlySet<string>;
  showsGone: boolean;
  colour: ColourMode;
  showsBoxes: boolean;
  theme: "system" | "dark" | "light";
  camera: CameraView | null;
  /** Where an object is held at or sent to, until the server has it there. */
  pending: { readonly id: string; readonly pose: Pose } | null;
  /** What the object that is held would touch there, and did not touch where it was. */
  touched: readonly string[];
  robots: readonly Robot[];
  undoable: readonly number[];
  redoable: readonly number[];
  history: readonly LoggedEdit[];
  toast: Toast | null;
  tool: Tool;
  /** At the height of the eyes, rather than round the map. */
  walks: boolean;
  probe: Probe | null;
  ray: CastRay | null;
  /** Whether it is wanted to be known what is near the selection, of which class ("": any thing), and what is. */
  asksNear: boolean;
  nearClass: string;
  near: { readonly id: string; readonly className: string; readonly objects: readonly NearObject[] } | null;
  /** None, one, or both ends of what is measured. */
  measured_m: readonly Vector3[];
  /** All beyond it is left away; null: nothing is. */
  clip: AxisBox | null;
  regions: readonly IgnoredRegion[];
  regionDraft: RegionDraft | null;
  /** Height of the floor plan that is shown, in the map frame. */
  slice_m: number | null;
  path: RobotPath;
  pathAnswer: PathAnswer | null;
  draft: Draft | null;
  /** What the draft would do, or why it cannot be done. */
  trial: { readonly text: string; readonly isGood: boolean } | null;
  showsHelp: boolean;
}

export type ViewStore = Store<ViewState>;

/** Whom what is asked is asked of. */
export function shownState(store: ViewStore): MapState | null {
  const map = store.get("map");
  return map && { name: map.name, at: store.get("at") };
}

export const newViewStore = (): ViewStore =>
  new Store<ViewState>({
    phase: { is: "connecting" },
    maps: [],
    map: null,
    revision: 0,
    at: null,
    present: new Map(),
    newest: 0,
    kept: [],
    showsTime: false,
    link: "off",
    objects: new Map(),
    selected: null,
    clicked: null,
    hovered: null,
    query: "",
    hiddenClasses: new Set(["ceiling"]),
    hiddenObjects: new Set(),
    showsGone: false,
    colour: "sensor",
    showsBoxes: false,
    theme: "system",
    camera: null,
    pending: null,
    touched: [],
    robots: [],
    undoable: [],
    redoable: [],
    history: [],
    toast: null,
    tool: "select",
    walks: false,
    probe: null,
    ray: null,
    asksNear: false,
    nearClass: "",
    near: null,
    measured_m: [],
    clip: null,
    regions: [],
    regionDraft: null,
    slice_m: null,
    path: { points_m: [], radius_m: 0.2, height_m: 0.6, seenAlone: false },
    pathAnswer: null,
    draft: null,
    trial: null,
    showsHelp: false,
  });
