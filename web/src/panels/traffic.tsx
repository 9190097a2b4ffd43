/** All other aircraft, the most urgent first: each can be chosen, and the display then shows its numbers. */

import "./traffic.css";
import { relativeAltitude, trendSign } from "../nd/leader";
import { choose } from "../nd/nd";
import { Panel } from "../parts";
import type { Session } from "../session";
import { type Traffic as Other, trafficOf } from "../store/traffic";
import { type Cell, cellsOf } from "../store/weather";
import { formatClock, formatMiles } from "../units";

/** As on the display: a disc, or a square. */
const MARK: Record<Other["urgency"] | Cell["urgency"], string> = {
  none: "",
  other: "",
  proximate: "",
  caution: "●",
  warning: "■",
};

function Mark({ urgency }: { urgency: keyof typeof MARK }) {
  if (MARK[urgency] === "") return null;
  return (
    <>
      <span aria-hidden="true">{MARK[urgency]} </span>
      <span class="visually-hidden">{urgency}: </span>
    </>
  );
}

export function Traffic({
  session: { flight, shown },
}: {
  session: Pick<Session, "flight" | "shown">;
}) {
  const reading = flight.read.value;
  const isHeard = shown.numbers.value.sample !== null;
  const traffic = isHeard ? trafficOf(reading).reverse() : [];
  const cells = isHeard ? cellsOf(reading) : [];
  const chosen = shown.chosen.value;
  return (
    <Panel
      name="traffic"
      title="Traffic"
      aside={<span class="hint">level, NM now, nearest</span>}
      scrolls
    >
      {traffic.length === 0 && cells.length === 0 ? (
        <p class="hint">Not known now: the data are too old.</p>
      ) : (
        <table class="list">
          <caption class="visually-hidden">Other aircraft, the most urgent first</caption>
          <thead class="visually-hidden">
            <tr>
              <th scope="col">Aircraft</th>
              <th scope="col">Level over own ship in hundreds of feet</th>
              <th scope="col">Distance in nautical miles</th>
              <th scope="col">Closest approach if both fly straight on</th>
            </tr>
          </thead>
          <tbody>
            {traffic.map((each) => (
              <tr key={each.ident} class={each.urgency}>
                <th scope="row">
                  <button
                    type="button"
                    class="link"
                    aria-pressed={chosen === each.ident}
                    title={each.follows === "" ? "" : `Joins ${each.follows}`}
                    onClick={() => choose(shown, each.ident)}
                  >
                    {each.ident}
                  </button>
                </th>
                <td>
                  {relativeAltitude(each.height)}
                  {trendSign(each.climb)}
                </td>
                <td>{formatMiles(each.distance)}</td>
                <td>
                  <Mark urgency={each.urgency} />
                  {nearest(each)}
                </td>
              </tr>
            ))}
            {cells.map(({ ident, urgency }) => (
              <tr key={ident} class={urgency}>
                <th scope="row">{ident}</th>
                <td colSpan={2}>weather</td>
                <td>
                  <Mark urgency={urgency} />
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </Panel>
  );
}

/** How near it comes if both fly straight on, and when. */
function nearest({ approach }: Other): string {
  if (approach.in <= 0) return "parting";
  return `${formatMiles(approach.least)} in ${formatClock(approach.in)}`;
}
