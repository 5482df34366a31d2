// SPDX-License-Identifier: BSD-3-Clause
// Parts of cards.
import { el } from "./dom";

export const percent = (share: number) => `${Math.round(100 * share)} %`;
export const metres = (length: number) => length.toFixed(2);

export const table = (rows: readonly (readonly [string, string])[]): HTMLElement =>
  el("dl", { class: "facts" }, ...rows.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));

export function numberField(
  label: string,
  value: string,
  unit: string,
  isDisabled: boolean,
  onEnter: (value: number) => void,
): HTMLElement {
  const input = el("input", { type: "number", value, disabled: isDisabled, aria: { label: `${label}, ${unit}` } });
  input.step = unit === "m" ? "0.05" : "15";
  input.addEventListener("keydown", (event) => {
    event.stopPropagation();
    if (event.key === "Escape") input.blur();
    if (event.key !== "Enter") return;
    const number = Number(input.value);
    input.blur();
    if (input.value !== "" && Number.isFinite(number) && input.value !== value) onEnter(number);
  });
  return el("label", { class: "number" }, el("span", {}, label), input, el("span", { class: "unit" }, unit));
}
