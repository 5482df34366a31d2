// SPDX-License-Identifier: BSD-3-Clause
// Colours of classes, objects and numbers, as linear red, green, blue for the scene and as text for the page.
import type { MapObject } from "../api/types";
import type { ColourMode } from "../state/view";

export type Rgb = readonly [number, number, number];

/** Linear light of an OKLCH colour; what the screen cannot show is cut off. Hue in turns. */
export function fromOklch(lightness: number, chroma: number, hue: number): Rgb {
  const a = chroma * Math.cos(2 * Math.PI * hue);
  const b = chroma * Math.sin(2 * Math.PI * hue);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const cut = (value: number) => Math.min(1, Math.max(0, value));
  return [
    cut(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    cut(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    cut(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

const goldenRatio = 0.6180339887;
const turns = (number: number) => (0.13 + number * goldenRatio) % 1;

/** A hue never comes near one used shortly before. Backgrounds are near grey. */
export function classColour(object: MapObject): Rgb {
  if (object.kind === "unknown") return fromOklch(0.5, 0.01, 0.7);
  if (object.kind === "stuff") return fromOklch(0.66, 0.018, turns(object.classId));
  return fromOklch(0.72, 0.1, turns(object.classId));
}

const objectColour = (object: MapObject): Rgb =>
  object.kind === "thing" ? fromOklch(0.7, 0.12, turns(Number(object.id))) : classColour(object);

const amber = fromOklch(0.76, 0.14, 0.2);
const calm = fromOklch(0.74, 0.015, 0.7);
/** From amber, which is what to look at, to a calm grey. */
const ramp = (share: number): Rgb => {
  const t = Math.min(1, Math.max(0, share));
  return [0, 1, 2].map((k) => (amber[k] ?? 0) * (1 - t) + (calm[k] ?? 0) * t) as unknown as Rgb;
};

/** One colour of all of an object, or null: as the sensor saw it. `age`: 0 of what was seen last, 1 of what first. */
export function flatColour(mode: ColourMode, object: MapObject, age: number): Rgb | null {
  if (!object.isPresent) return amber;
  switch (mode) {
    case "sensor":
      return null;
    case "class":
      return classColour(object);
    case "object":
      return objectColour(object);
    case "confidence":
      return ramp((object.classConfidence - 0.4) / 0.55);
    case "last seen":
      return ramp(1 - age);
    case "presence":
      return object.kind === "unknown" ? amber : calm;
  }
}

export function cssColour(colour: Rgb): string {
  const step = (linear: number) => {
    const value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
    return Math.round(255 * value);
  };
  return `rgb(${colour.map(step).join(" ")})`;
}
