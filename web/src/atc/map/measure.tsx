/** The line of the pair tool: from one aircraft to the other, and to where they are closest straight on. */

import { closestOf } from "../closest";
import { aircraftOf } from "../sky";
import type { Station } from "../station";
import { lineOf, toPoint } from "./view";

export function Measure({ station: { view, store, picked } }: { station: Station }) {
  const sky = store.sky.value;
  const [a, b] = picked.value.map((ident) => aircraftOf(sky, ident));
  if (!a || !b) return null;
  const { places, after } = closestOf(a, b);
  return (
    <g class="atc-measure">
      <path class="between" d={lineOf(view, [a, b])} />
      {after > 0 && (
        <>
          <path class="way" d={lineOf(view, [a, places[0]])} />
          <path class="way" d={lineOf(view, [b, places[1]])} />
          <path class="least" d={lineOf(view, places)} />
          {places.map((each, k) => {
            const { x, y } = toPoint(view, each);
            return <circle key={k === 0 ? "first" : "second"} cx={x} cy={y} r={4} />;
          })}
        </>
      )}
    </g>
  );
}
