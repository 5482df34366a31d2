// SPDX-License-Identifier: BSD-3-Clause
import { logIn } from "../api/login";
import { el } from "./dom";

/** Asks for a key until the server takes one. */
export function newLoginForm(onDone: () => void): HTMLFormElement {
  const key = el("input", { class: "search", type: "password", placeholder: "dhp_…", aria: { label: "Key" } });
  key.autocomplete = "current-password";
  const problem = el("p", { class: "said problem", role: "alert" });
  const send = el("button", { type: "submit", class: "button" }, "Open");
  const form = el("form", { class: "login" }, key, send, problem);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    send.disabled = true;
    logIn(key.value.trim())
      .then(onDone)
      .catch((error: unknown) => {
        problem.textContent = error instanceof Error ? error.message : String(error);
        key.select();
      })
      .finally(() => (send.disabled = false));
  });
  return form;
}
