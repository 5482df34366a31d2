// SPDX-License-Identifier: BSD-3-Clause
// Wiring: the store, what shows it, what changes it.
import { Vector3 } from "three";
import { EditLog } from "./actions/edit_log";
import { Edits } from "./actions/edits";
import { Ahead } from "./api/ahead";
import { el } from "./panels/dom";
import { Inspector } from "./panels/inspector";
import { newClipCard } from "./panels/clip_card";
import { listenToKeys } from "./panels/keyboard";
import { newLabel } from "./panels/label";
import { newMeasureCard } from "./panels/measure_card";
import { ObjectList } from "./panels/object_list";
import { newHelp, newOverlay } from "./panels/overlay";
import { newPastCard } from "./panels/past_card";
import { newPathCard } from "./panels/path_card";
import { newRayCard } from "./panels/ray_card";
import { newRegionCard } from "./panels/region_card";
import { newSliceCard } from "./panels/slice_card";
import { StatusBar } from "./panels/status_bar";
import { newTimeline } from "./panels/timeline";
import { TopBar } from "./panels/top_bar";
import { SceneFollower } from "./scene/follow";
import { Renderer } from "./scene/renderer";
import { SurfaceLoader } from "./scene/surface_loader";
import { Session } from "./session";
import { keepLink, linkOf } from "./link";
import { Past } from "./past";
import { forgetMap } from "./state/history";
import { readLink } from "./state/url";
import { newViewStore, type ViewStore } from "./state/view";
import { followTheme } from "./theme";
import { ClipTool } from "./tools/clip";
import { DraftTool } from "./tools/draft";
import { MeasureTool } from "./tools/measure";
import { MoveTool } from "./tools/move";
import { NearTool } from "./tools/near";
import { PathTool } from "./tools/path";
import { Pointer } from "./tools/pointer";
import { ProbeTool } from "./tools/probe";
import { RayTool } from "./tools/ray";
import { RegionTool } from "./tools/region";
import { saveScreenshot } from "./tools/screenshot";
import { RobotFollower } from "./tools/robots";
import { SliceTool } from "./tools/slice";
import { WalkTool } from "./tools/walk";
import { TouchCheck } from "./tools/touch";
import { pivotOf } from "./tools/poses";

const narrow_px = 900;
const mostAhead_ms = 300;
const fromAbove = { yaw: Math.PI / 2, pitch: -Math.PI / 2 };
const fromASide = { yaw: Math.PI / 2 + 0.34, pitch: -0.95 };

function start(store: ViewStore, ahead: Ahead): void {
  let renderer: Renderer;
  try {
    renderer = new Renderer(() => store.set("camera", renderer?.camera.view ?? null));
  } catch {
    store.set("phase", { is: "no webgl" });
    document.body.append(el("main", { class: "scene" }, newOverlay(store)));
    return;
  }
  const follower = new SceneFollower(store, renderer);
  const log = new EditLog(store);
  const edits = new Edits(store, log);
  const moveTool = new MoveTool(store, renderer, edits, new TouchCheck(store));
  const placeTools = {
    probe: new ProbeTool(store, renderer),
    path: new PathTool(store, renderer),
    ray: new RayTool(store, renderer),
    measure: new MeasureTool(store, renderer),
    region: new RegionTool(store, renderer),
  };
  const clipTool = new ClipTool(store, renderer);
  const draftTool = new DraftTool(store, renderer, edits);
  new RobotFollower(store, renderer);
  new NearTool(store);
  const slice = new SliceTool(store, renderer);
  const surfaces = new SurfaceLoader(
    (loaded) => {
      for (const surface of loaded) if (store.get("objects").has(surface.id)) renderer.put(surface);
      follower.refresh();
      if (store.get("phase").is === "loading") {
        store.set("phase", { is: "ready" });
        if (!store.get("camera")) frameAll(true);
      }
      statusBar.count();
    },
    (bytes) => {
      if (store.get("phase").is === "loading") store.set("phase", { is: "loading", bytes });
    },
    (error) =>
      store.set("toast", {
        text: `Surfaces were not sent: ${error instanceof Error ? error.message : String(error)}`,
        tone: "problem",
      }),
  );

  const isBeside = () => innerWidth > narrow_px;
  const coverRight = () => {
    renderer.camera.covered_px = isBeside() && !inspector.element.hidden ? inspector.element.offsetWidth : 0;
  };
  const frameAll = (isAtOnce = false, angles: { yaw: number; pitch: number } | null = fromASide) => {
    const box = renderer.bounds();
    if (box.isEmpty()) return;
    const size = box.getSize(new Vector3());
    coverRight();
    renderer.camera.frame(
      box.getCenter(new Vector3()),
      0.36 * Math.hypot(size.x, size.y, 0.5 * size.z),
      angles,
      isAtOnce,
    );
  };
  const focusOn = (id: string) => {
    const object = store.get("objects").get(id);
    coverRight();
    if (object) renderer.camera.frame(pivotOf(object), 1.6 * Math.min(4, object.sphere?.radius_m ?? 1), null, false);
  };
  const resize = () => {
    const hasList = isBeside() && !document.body.classList.contains("no-list");
    renderer.resize(scene.clientWidth, scene.clientHeight, hasList ? list.element.offsetWidth : 0);
  };
  const toggleList = () => {
    document.body.classList.toggle("no-list");
    resize();
  };
  const session = new Session(store, renderer, surfaces, ahead, () => void log.refresh());
  const past = new Past(store, session);
  const showRevision = (revision: number | null) => past.show(revision);
  const list = new ObjectList(store, focusOn);
  const actions = {
    openMap: (map: Parameters<Session["open"]>[0]) => {
      store.set("selected", null);
      store.set("hiddenObjects", new Set());
      store.set("camera", null);
      forgetMap(store);
      void session.open(map).then(() => log.refresh());
    },
    frameAll: () => {
      store.set("walks", false);
      frameAll();
    },
    lookDown: () => {
      store.set("walks", false);
      frameAll(false, fromAbove);
    },
    toggleList,
    showRevision,
    stepTime: (by: 1 | -1) => past.step(by),
    toggleClip: () => clipTool.toggle(),
    saveScreenshot: () => void saveScreenshot(store, renderer, linkOf(store)),
    focusSearch: () => {
      if (document.body.classList.contains("no-list")) toggleList();
      list.search.focus();
    },
    focusSelection: () => {
      if (store.get("selected") !== null) focusOn(store.get("selected") ?? "");
    },
  };
  const inspector = new Inspector(store, edits, moveTool, focusOn, [
    newPastCard(store, () => past.show(null)),
    newSliceCard(store),
    newClipCard(store, clipTool),
    newMeasureCard(store),
    newRayCard(store, placeTools.ray),
    newPathCard(store),
    newRegionCard(store, edits, placeTools.region),
  ]);
  const statusBar = new StatusBar(store, renderer, edits);
  const label = newLabel(store);
  const overlay = newOverlay(store, actions.openMap, () => session.retryNow());
  const scene = el("main", { class: "scene", aria: { label: "Map" } }, renderer.canvas, overlay);
  renderer.canvas.tabIndex = 0;
  renderer.canvas.setAttribute("aria-label", "The map in 3D. Keys: question mark.");
  document.body.append(
    new TopBar(store, edits, actions).element,
    list.element,
    scene,
    inspector.element,
    newTimeline(store, { show: showRevision, step: actions.stepTime }),
    statusBar.element,
    label,
    newHelp(store),
  );
  if (innerWidth <= narrow_px) toggleList();
  new Pointer(store, renderer, moveTool, placeTools, draftTool, label, focusOn);
  listenToKeys(store, edits, moveTool, new WalkTool(store, renderer), actions);
  followTheme(store, renderer);
  new ResizeObserver(resize).observe(scene);
  const link = keepLink(store);
  if (link.camera) renderer.camera.setView(link.camera);
  else store.set("camera", null);
  void session.start(link.mapId).then(() => {
    void log.refresh();
    if (link.at === null || !store.get("map")) return;
    store.set("showsTime", true);
    past.show(link.at);
  });
  // For tests, and for who opens the console.
  Object.assign(window, { dhpmap: { store, renderer, surfaces, slice } });
}

const store = newViewStore();
const ahead = new Ahead(readLink(location.hash).mapId, (bytes) => {
  const phase = store.get("phase");
  if (phase.is === "loading") store.set("phase", { is: "loading", bytes: phase.bytes + bytes });
});
// WebGL keeps the page busy for a while: the server is asked before.
void Promise.race([ahead.isAsked, new Promise((done) => setTimeout(done, mostAhead_ms))]).then(() =>
  start(store, ahead),
);
