/** Every state of the display as a full picture, and which elements are drawn in it, on one page. */

import { readFileSync } from "node:fs";
import { signal } from "@preact/signals";
import { createShown } from "../../src/store/shown";
import { GUIDANCES, type Guidance } from "../../src/store/states";
import { mountDisplay } from "./draw";
import { ELEMENT_ROWS } from "./elements";
import { flightIn } from "./in-state";

export const ROOTS = new Map<Guidance, Element>(
  GUIDANCES.map((state) => [
    state,
    mountDisplay({
      shown: createShown(flightIn(state)),
      mode: signal<"ROSE" | "ARC">("ROSE"),
      range: signal(80),
    }),
  ]),
);

/** Whether something of it is drawn: a line that leads somewhere, a circle, or text. */
export function isDrawn(root: Element, selector: string): boolean {
  return [...root.querySelectorAll(selector)].some((mark) => {
    if (mark.matches("path")) return (mark.getAttribute("d") ?? "") !== "";
    return mark.matches("text") ? (mark.textContent ?? "") !== "" : true;
  });
}

const STYLES = ["styles/tokens.css", "nd/nd.css"];
const LAYOUT = `body { margin: 16px; background: #14181d; color: #e8ecf0; font: 14px sans-serif }
  .nd-flash { animation: none }
  main { display: grid; grid-template-columns: repeat(4, 1fr); gap: 12px }
  h2 { margin: 0 0 4px; font-size: 15px } .nd-display { aspect-ratio: 1; height: auto; overflow: hidden }
  table { border-collapse: collapse; margin-top: 16px } th, td { padding: 1px 8px; text-align: left }
  td { text-align: center; color: #00ff00 }`;

/** The page, whole in itself. */
export function pageOfStates(): string {
  const styles = STYLES.map((name) => readFileSync(`src/${name}`, "utf8"));
  const pictures = GUIDANCES.map((state) => {
    const picture = ROOTS.get(state)?.innerHTML ?? "";
    return `<section><h2>${state}</h2>${picture}</section>`;
  });
  const rows = ELEMENT_ROWS.map(({ number, name, selector, why, states }) => {
    const said = why ?? (states.size > 0 ? null : "it comes with an event, whatever the state");
    const cells = GUIDANCES.map((state) => {
      const root = ROOTS.get(state);
      const drawn = root !== undefined && selector !== null && isDrawn(root, selector);
      return `<td>${drawn ? "●" : ""}</td>`;
    });
    const shown = said === null ? cells.join("") : `<td colspan="${GUIDANCES.length}">${said}</td>`;
    return `<tr><th>${number} ${name}</th>${shown}</tr>`;
  });
  const heads = GUIDANCES.map((state) => `<th>${state}</th>`).join("");
  return `<!doctype html><html lang="en"><meta charset="utf-8"><title>All states</title>
<style>${styles.join("")}${LAYOUT}</style>
<main>${pictures.join("")}</main>
<table><tr><th></th>${heads}</tr>${rows.join("")}</table>`;
}
