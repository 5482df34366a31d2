// SPDX-License-Identifier: BSD-3-Clause
// The picture as a file: with a line below it that says of what it is, and the link of the view in it.
import type { Renderer } from "../scene/renderer";
import { withPngText } from "../state/png_text";
import type { ViewStore } from "../state/view";

const line_px = 28;
const margin_px = 10;

const colourOf = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** `link`: of what is shown. Saved by the browser as it saves files. */
export async function saveScreenshot(store: ViewStore, renderer: Renderer, link: string): Promise<void> {
  const map = store.get("map");
  if (!map) return;
  const title = `${map.displayName}, revision ${store.get("revision")}`;
  const picture = withLine(renderer.snapshot(), title, link);
  const blob = await new Promise<Blob | null>((done) => picture.toBlob(done, "image/png"));
  if (!blob) return store.set("toast", { text: "The browser makes no picture of it", tone: "problem" });
  const noted = withPngText(new Uint8Array(await blob.arrayBuffer()), "Source", encodeURI(decodeURI(link)));
  const url = URL.createObjectURL(new Blob([noted], { type: "image/png" }));
  const anchor = document.createElement("a");
  anchor.href = url;
  anchor.download = `${map.id}-r${store.get("revision")}.png`;
  anchor.click();
  window.setTimeout(() => URL.revokeObjectURL(url), 60_000);
  store.set("toast", { text: `${anchor.download} is saved, with the link of this view in it`, tone: "plain" });
}

function withLine(picture: HTMLCanvasElement, title: string, link: string): HTMLCanvasElement {
  const scale = Math.max(1, devicePixelRatio);
  const canvas = document.createElement("canvas");
  canvas.width = picture.width;
  canvas.height = picture.height + line_px * scale;
  const pen = canvas.getContext("2d");
  if (!pen) return picture;
  pen.drawImage(picture, 0, 0);
  pen.fillStyle = colourOf("--panel");
  pen.fillRect(0, picture.height, canvas.width, line_px * scale);
  pen.scale(scale, scale);
  pen.font = "600 12px system-ui, sans-serif";
  pen.textBaseline = "middle";
  pen.fillStyle = colourOf("--text");
  const y = picture.height / scale + line_px / 2;
  pen.fillText(title, margin_px, y);
  const begin = 2 * margin_px + pen.measureText(title).width;
  pen.font = "11px ui-monospace, monospace";
  pen.fillStyle = colourOf("--muted");
  pen.fillText(fitted(pen, link, canvas.width / scale - begin - margin_px), begin, y);
  return canvas;
}

/** As much of it as there is room for. */
function fitted(pen: CanvasRenderingContext2D, text: string, room_px: number): string {
  if (pen.measureText(text).width <= room_px) return text;
  const each = pen.measureText("m").width;
  return `${text.slice(0, Math.max(0, Math.floor(room_px / each) - 1))}…`;
}
