/** The pair tool: how far two aircraft are apart, and how close they come if both fly straight on. */

import { FT, formatClock, formatHeading, formatMiles } from "../units";
import { closestOf } from "./closest";
import { aircraftOf } from "./sky";
import type { Station } from "./station";

export function PairTool({ station }: { station: Station }) {
  const { store, picked } = station;
  const sky = store.sky.value;
  const [first = "", second = ""] = picked.value;
  const set = (k: 0 | 1, ident: string) => {
    picked.value = (k === 0 ? [ident, second] : [first, ident]).filter((each) => each !== "");
  };
  return (
    <section class="atc-panel atc-pair-tool" aria-labelledby="pair-tool">
      <header>
        <h2 id="pair-tool">Pair tool</h2>
        <span class="unit">click two aircraft, or choose them</span>
      </header>
      <div class="fields">
        <Choice label="From" ident={first} idents={sky.aircraft} set={(each) => set(0, each)} />
        <Choice label="To" ident={second} idents={sky.aircraft} set={(each) => set(1, each)} />
        <p role="status">{sentenceOf(station)}</p>
      </div>
    </section>
  );
}

function Choice(props: {
  label: string;
  ident: string;
  idents: readonly { readonly ident: string }[];
  set: (ident: string) => void;
}) {
  return (
    <label>
      {props.label}
      <select value={props.ident} onChange={({ currentTarget }) => props.set(currentTarget.value)}>
        <option value="">–</option>
        {props.idents.map(({ ident }) => (
          <option key={ident} value={ident}>
            {ident}
          </option>
        ))}
      </select>
    </label>
  );
}

/** Range, bearing, height and closest approach in a sentence. */
export function sentenceOf({ store, picked }: Pick<Station, "store" | "picked">): string {
  const [a, b] = picked.value.map((ident) => aircraftOf(store.sky.value, ident));
  if (!a || !b) return "";
  const { range, bearing, after, least, vertical } = closestOf(a, b);
  const height = vertical === null ? "" : `, ${Math.round(vertical / FT)} ft between them`;
  const now = `${formatMiles(range)} NM, bearing ${formatHeading(bearing)}°${height}. `;
  if (after === 0) return `${now}They part, or keep their distance.`;
  return `${now}Straight on: ${formatMiles(least)} NM in ${formatClock(after)}.`;
}
