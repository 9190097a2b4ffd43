/** CARD: time to conflict against least distance, a dot for each pair, and the same as a list. */

import { ticksOf } from "../charts/scale";
import { formatClock, formatMiles, NM } from "../units";
import { type Conflict, conflictsOf, soonOf } from "./pairs";
import { choose, type Station } from "./station";
import { CERTAINTIES } from "./words";

const WIDTH = 340;
const HEIGHT = 176;
const EDGE = { left: 34, right: 10, top: 10, bottom: 26 } as const;
/** The axes reach at least so far: twenty minutes, and so many miles. */
const LONG = 1200;
const WIDE = 12 * NM;

export function Card({ station }: { station: Station }) {
  const conflicts = conflictsOf(station.store.sky.value);
  return (
    <section class="atc-panel atc-card" aria-labelledby="card">
      <header>
        <h2 id="card">CARD</h2>
        <span class="unit">time to conflict × least distance</span>
      </header>
      <div class="atc-card-body">
        <Plot station={station} conflicts={conflicts} />
        <List station={station} conflicts={conflicts} />
      </div>
    </section>
  );
}

interface Props {
  readonly station: Station;
  readonly conflicts: readonly Conflict[];
}

function Plot({ station, conflicts }: Props) {
  const longest = Math.max(LONG, ...conflicts.map(({ after }) => after));
  const widest = Math.min(30 * NM, Math.max(WIDE, ...conflicts.map(({ pair }) => pair.least_m)));
  const x = (after: number) => EDGE.left + (after / longest) * (WIDTH - EDGE.left - EDGE.right);
  const y = (least: number) =>
    HEIGHT - EDGE.bottom - (Math.min(least, widest) / widest) * (HEIGHT - EDGE.top - EDGE.bottom);
  const minimum = Math.max(0, ...conflicts.map(({ pair }) => pair.minimum_m)) || 5 * NM;
  return (
    <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={sentenceOf(conflicts)}>
      <g class="soon">
        <rect x={x(0)} y={EDGE.top} width={x(300) - x(0)} height={y(0) - EDGE.top} />
        <text x={x(300) - 3} y={EDGE.top + 10}>
          5 min
        </text>
        <path d={`M${x(300)} ${EDGE.top}V${y(0)}M${x(480)} ${EDGE.top}V${y(0)}`} />
        <text x={x(480) - 3} y={EDGE.top + 10}>
          8 min
        </text>
      </g>
      <g class="axes">
        <path d={`M${EDGE.left} ${EDGE.top}V${y(0)}H${WIDTH - EDGE.right}`} />
        {ticksOf(0, longest / 60, 5).map((minutes) => (
          <text key={minutes} x={x(60 * minutes)} y={HEIGHT - 12} text-anchor="middle">
            {minutes}
          </text>
        ))}
        <text x={WIDTH - EDGE.right} y={HEIGHT - 1} text-anchor="end">
          min
        </text>
        {ticksOf(0, widest / NM, 4).map((miles) => (
          <text key={miles} x={EDGE.left - 5} y={y(miles * NM) + 4} text-anchor="end">
            {miles}
          </text>
        ))}
        <text x={2} y={HEIGHT - 1}>
          NM
        </text>
      </g>
      <path class="minimum" d={`M${EDGE.left} ${y(minimum)}H${WIDTH - EDGE.right}`} />
      <text class="minimum" x={WIDTH - EDGE.right} y={y(minimum) - 4} text-anchor="end">
        {`MIN ${formatMiles(minimum)} NM`}
      </text>
      {conflicts.map((each) => (
        // biome-ignore lint/a11y/noStaticElementInteractions: the list beside it is for keys
        <path
          key={keyOf(each)}
          class={`dot ${each.pair.certainty}${isChosen(station, each) ? " chosen" : ""}`}
          transform={`translate(${x(each.after)} ${y(each.pair.least_m)})`}
          d={SHAPES[each.pair.certainty]}
          onClick={() => choose(station, each.card.id, each.pair.ident)}
        />
      ))}
    </svg>
  );
}

/** A shape for each: squares are certain, triangles possible, circles clear. */
const SHAPES = {
  certain: "M-5 -5h10v10h-10Z",
  possible: "M0 -6L6 5H-6Z",
  clear: "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0Z",
} as const;

function List({ station, conflicts }: Props) {
  if (conflicts.length === 0) return <p class="hint">No pairs: nothing is asked for or flown.</p>;
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls, and is scrolled by keyboard
    <section class="atc-pairs" tabIndex={0} aria-label="Pairs">
      <ul>
        {conflicts.map((each) => {
          const { word, tone } = CERTAINTIES[each.pair.certainty];
          const soon = each.pair.certainty === "clear" ? "later" : soonOf(each.after);
          return (
            <li key={keyOf(each)}>
              <button
                type="button"
                aria-pressed={isChosen(station, each)}
                onClick={() => choose(station, each.card.id, each.pair.ident)}
              >
                <span class={`verdict ${tone}`}>{word}</span>
                <b>{`${each.card.aircraft}–${each.pair.ident}`}</b>
                <span>{`${formatMiles(each.pair.least_m)} NM`}</span>
                <span>{`in ${formatClock(each.after)}`}</span>
                {soon !== "later" && <span class={`soon ${tone}`}>{`< ${soon}`}</span>}
              </button>
            </li>
          );
        })}
      </ul>
    </section>
  );
}

function isChosen({ selected, pair }: Station, each: Conflict): boolean {
  return each.card.id === selected.value && each.pair.ident === pair.value;
}

function keyOf({ card, pair }: Conflict): string {
  return `${card.id} ${pair.ident}`;
}

function sentenceOf(conflicts: readonly Conflict[]): string {
  const near = conflicts.filter(({ pair }) => pair.certainty !== "clear").length;
  return `${conflicts.length} pairs, ${near} of them too close. The list beside it says each.`;
}
