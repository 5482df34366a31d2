// SPDX-License-Identifier: BSD-3-Clause
// Elements without HTML text: what a map says never becomes markup.

type Child = Node | string | null;
interface Props {
  readonly class?: string;
  readonly title?: string;
  readonly id?: string;
  readonly role?: string;
  readonly type?: string;
  readonly value?: string;
  readonly placeholder?: string;
  readonly tabIndex?: number;
  readonly hidden?: boolean;
  readonly disabled?: boolean;
  readonly aria?: { readonly [name: string]: string };
  readonly data?: { readonly [name: string]: string };
  readonly onClick?: (event: MouseEvent) => void;
}

export function el<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  props: Props = {},
  ...children: readonly Child[]
): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  if (props.class) element.className = props.class;
  if (props.title) element.title = props.title;
  if (props.id) element.id = props.id;
  if (props.role) element.setAttribute("role", props.role);
  if (props.tabIndex !== undefined) element.tabIndex = props.tabIndex;
  if (props.hidden) element.hidden = true;
  for (const name of ["type", "value", "placeholder"] as const) {
    const value = props[name];
    if (value !== undefined) element.setAttribute(name, value);
  }
  if (props.disabled) element.setAttribute("disabled", "");
  for (const [name, value] of Object.entries(props.aria ?? {})) element.setAttribute(`aria-${name}`, value);
  for (const [name, value] of Object.entries(props.data ?? {})) element.dataset[name] = value;
  if (props.onClick) element.addEventListener("click", props.onClick as EventListener);
  element.append(...children.filter((child): child is Node | string => child !== null));
  return element;
}

const icons = {
  eye: "M1 8s2.6-4.6 7-4.6S15 8 15 8s-2.6 4.6-7 4.6S1 8 1 8zm7 2.2A2.2 2.2 0 1 0 8 5.8a2.2 2.2 0 0 0 0 4.4z",
  hidden:
    "M2 2l12 12M6 4a7 7 0 0 1 2-.6c4.400 0 7 4.600 7 4.600a12 12 0 0 1-2.100 2.600M10 12a7 7 0 0 1-2 .6C3.600 12.600 1 8 1 8a12 12 0 0 1 2.700-3",
  undo: "M6 3L2.500 6.500 6 10M3 6.500h6a4 4 0 0 1 0 8H7",
  redo: "M10 3l3.500 3.500L10 10M13 6.500H7a4 4 0 0 0 0 8h2",
  frame: "M2 5V2h3M11 2h3v3M14 11v3h-3M5 14H2v-3",
  top: "M8 1v9M4.500 6.500L8 10l3.500-3.500M2 14h12",
  box: "M8 1.500l6 3v7l-6 3-6-3v-7zM2 4.500l6 3 6-3M8 7.500v7",
  lock: "M4 7V5a4 4 0 0 1 8 0v2M3 7h10v7H3z",
  theme: "M8 2a6 6 0 1 0 0 12zM8 2a6 6 0 0 1 0 12",
  help: "M6 6a2 2 0 1 1 2.700 1.900c-.500.200-.700.600-.700 1.100v.500M8 12.200v.1",
  probe: "M8 1v5M8 10v5M1 8h5M10 8h5",
  list: "M2 4h12M2 8h12M2 12h12",
  close: "M3.500 3.500l9 9M12.500 3.500l-9 9",
  walk: "M8.500 3.500a1.200 1.200 0 1 0 0-2.400 1.200 1.200 0 0 0 0 2.400zM8.500 5L7 9l2.500 2.500V15M7 9l-1 3-2.500 2.500M8.500 5L5.500 6.500V9M8.500 5l1.500 2.500 2.500 1",
  path: "M2.500 13.500a1.500 1.500 0 1 0 3 0 1.500 1.500 0 0 0-3 0zM5.500 13.500H11a3 3 0 0 0 0-6H6a2.500 2.500 0 0 1 0-5h4.500M9 .8l2 1.700-2 1.700",
  slice: "M2 5.500l6-3 6 3-6 3zM2 10.500l6 3 6-3",
  clock: "M8 2a6 6 0 1 0 0 12A6 6 0 0 0 8 2zM8 4.500V8l2.500 1.500",
  ray: "M2.500 13.500L12 4M8.500 3.500L12.500 3.500 12.500 7.500M2.500 13.500h.1",
  measure: "M1.500 11l9.500-9.500 3.500 3.500-9.500 9.500zM4 8.500l1.500 1.500M6.500 6l2 2M9 3.500l1.500 1.500",
  clip: "M4 1v11h11M1 4h11v11",
  region: "M2 2h12v12H2zM4 12l8-8M4 8l4-4M8 12l4-4",
  camera: "M2 5h2.500L6 3h4l1.500 2H14v8H2zM8 11a2.300 2.300 0 1 0 0-4.600A2.300 2.300 0 0 0 8 11z",
  link: "M6.500 9.500l3-3M7 4.500l1.500-1.500a3 3 0 0 1 4.500 4.500L11.500 9M9 11.500L7.500 13A3 3 0 0 1 3 8.500L4.500 7",
} as const;
export type IconName = keyof typeof icons;

export function icon(name: IconName): SVGSVGElement {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("aria-hidden", "true");
  svg.classList.add("icon");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", icons[name]);
  svg.append(path);
  return svg;
}

export function button(name: IconName | null, label: string, title: string, onClick: () => void): HTMLButtonElement {
  return el(
    "button",
    { type: "button", class: label ? "button" : "button only-icon", title, aria: { label: title }, onClick },
    name ? icon(name) : null,
    label || null,
  );
}
