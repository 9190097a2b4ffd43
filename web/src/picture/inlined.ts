/**
 * A drawing without its style sheet: what nd.css says of the classes becomes attributes, tokens become
 * colours, and numbers have no more digits than are seen.
 */

import type { Palette } from "./palettes";

/** What nd.css says of each class that has a look. */
const LOOKS: Readonly<Record<string, string>> = {
  "nd-halo": 'fill="none" stroke-linejoin="round" stroke="var(--halo)"',
  "nd-stroke": 'fill="none" stroke-linejoin="round"',
  "nd-hollow": 'fill="var(--glass)" stroke-linejoin="round"',
  "nd-solid": 'paint-order="stroke" stroke="var(--halo)" stroke-linejoin="round" stroke-width="3"',
  "nd-text": 'paint-order="stroke" stroke="var(--halo)" stroke-linejoin="round" stroke-width="4.5"',
  "nd-ground": 'fill="var(--glass)" fill-opacity="0.82"',
  "nd-frame": 'stroke-width="2"',
  "nd-rule": 'fill="none" stroke="var(--scale)" stroke-opacity="0.55" stroke-width="1.5"',
  "nd-box": 'fill="none" stroke="var(--scale)" stroke-width="2"',
};

const TAG = /<(\w+)((?: [\w:-]+(?:="[^"]*")?)*)>(?:<\/\1>)?/g;
const ATTRIBUTE = / ([\w:-]+)="([^"]+)"/g;
const LONG_NUMBER = /-?\d+\.\d{4,}(?:e-?\d+)?/g;

const EMPTY_GROUP = /<g(?: [\w:-]+="[^"]*")*><\/g>/g;

/**
 * The same drawing as XML that needs no style sheet. Left out are lines that lead nowhere, empty texts,
 * and what is there for fingers only.
 *
 * @param markup - as HTML, in which an attribute may stand without a value.
 * @param fading - how much is still seen of what fades, 1 at first.
 */
export function inlined(markup: string, palette: Palette, fading: number): string {
  let drawn = markup.replace(TAG, (whole, name: string, attributes: string) => {
    const isEmpty = whole.endsWith(`</${name}>`);
    if (isEmpty && name === "text") return "";
    if (name === "path" && !attributes.includes(' d="')) return "";
    if (attributes.includes(' class="nd-touch"')) return "";
    if (isEmpty && name === "g") return whole;
    return `<${name}${looks(attributes, palette, fading)}${isEmpty ? "/>" : ">"}`;
  });
  for (let before = ""; before !== drawn; ) {
    before = drawn;
    drawn = drawn.replace(EMPTY_GROUP, "");
  }
  return drawn;
}

function looks(attributes: string, palette: Palette, fading: number): string {
  let written = "";
  for (const [whole, name, value = ""] of attributes.matchAll(ATTRIBUTE)) {
    const classes = name === "class" ? value.split(" ") : [];
    const found = classes.flatMap((each) => LOOKS[each] ?? []);
    if (classes.includes("nd-fading")) found.push(`opacity="${fading}"`);
    written += found.length === 0 ? whole : ` ${found.join(" ")}`;
  }
  return written
    .replace(/var\(--([a-z-]+)\)/g, (_, name: string) => palette[name as keyof Palette])
    .replace(LONG_NUMBER, (digits) => String(Math.round(Number(digits) * 1000) / 1000 + 0));
}
