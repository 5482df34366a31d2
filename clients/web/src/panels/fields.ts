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
  // Not of type number: a browser makes 26 of 2,6 where its language has a decimal point.
  const input = el("input", { type: "text", value, disabled: isDisabled, aria: { label: `${label}, ${unit}` } });
  input.inputMode = "decimal";
  const step = unit === "m" ? 0.05 : 15;
  const typed = () => (input.value.trim() === "" ? NaN : Number(input.value.replace(",", ".")));
  input.addEventListener("keydown", (event) => {
    event.stopPropagation();
    const steps = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (steps !== undefined && Number.isFinite(typed())) input.value = (typed() + steps * step).toFixed(unit === "m" ? 2 : 0);
    if (event.key === "Escape") input.blur();
    if (event.key !== "Enter") return;
    const number = typed();
    if (!Number.isFinite(number)) {
      input.value = value;
      input.select();
      return;
    }
    input.blur();
    if (input.value !== value) onEnter(number);
  });
  return el("label", { class: "number" }, el("span", {}, label), input, el("span", { class: "unit" }, unit));
}
