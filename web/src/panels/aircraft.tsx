/** Both aircraft side by side, and what guidance asks of the own one. */

import { useSignal } from "@preact/signals";
import { Dial } from "../dial";
import { trendSign } from "../nd/leader";
import { AlarmLine, Panel } from "../parts";
import type { Actions, Session } from "../session";
import { referenceText } from "../store/reading";
import { formatBank, formatHeading, formatKnots, formatLevel } from "../units";
import type { AircraftSample } from "../wire";

const ROWS: readonly (readonly [string, string, (aircraft: AircraftSample) => string])[] = [
  ["Heading", "°", (aircraft) => formatHeading(aircraft.heading_deg)],
  ["Track", "°", (aircraft) => formatHeading(aircraft.track_deg)],
  ["Bank", "°", (aircraft) => formatBank(aircraft.bank_deg)],
  ["TAS", "kt", (aircraft) => formatKnots(aircraft.tas_mps)],
  ["GS", "kt", (aircraft) => formatKnots(aircraft.ground_speed_mps)],
  ["Level", "", (aircraft) => formatLevel(aircraft.altitude_m)],
];

export function Aircraft(props: { session: Session; actions: Actions }) {
  // The dial shows what is flown until it is used.
  const heading = useSignal<number | null>(null);
  const numbers = props.session.shown.numbers.value;
  const { sample, leader, commandedSpeed } = numbers;
  const { climbs } = props.session.flight.read.value;
  const isGuided = sample?.engagement === "engaged";
  const started = props.session.flight.read.value.started;
  const idents = [started?.pursuer.ident ?? "Own", started?.leader.ident ?? "Leader"] as const;
  const heads = (
    <span class="idents" aria-hidden="true">
      <b class="key-pursuer">{idents[0]}</b>
      <b class="key-leader">{idents[1]}</b>
    </span>
  );
  return (
    <Panel
      name="aircraft"
      title="Aircraft"
      aside={heads}
      scrolls
      {...(numbers.alarm !== null && { alarm: numbers.alarm.level })}
    >
      <AlarmLine numbers={numbers} />
      <table class="states">
        <thead class="visually-hidden">
          <tr>
            <td />
            <th scope="col">{idents[0]}</th>
            <th scope="col">{idents[1]}</th>
          </tr>
        </thead>
        <tbody>
          {ROWS.map(([name, unit, text]) => (
            <tr key={name}>
              <th scope="row">
                {name}
                {unit !== "" && <span class="unit">{unit}</span>}
              </th>
              <td>
                {sample === null ? "––" : text(sample.pursuer)}
                {name === "Level" &&
                  sample !== null &&
                  trendSign(climbs.get(sample.pursuer.ident) ?? 0)}
              </td>
              <td>
                {leader === null ? "––" : text(leader)}
                {name === "Level" && leader !== null && trendSign(climbs.get(leader.ident) ?? 0)}
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class={`commanded ${isGuided ? "" : "selected"}`}>
        <span>{isGuided ? "Guidance" : "Selected"}</span>
        <b>{sample === null ? "––" : referenceText(sample.reference)}</b>
        <b>{sample === null ? "" : `${commandedSpeed} kt`}</b>
      </p>
      {sample !== null && !isGuided && (
        <div class="row labelled heading-dial">
          <span aria-hidden="true">HDG</span>
          <Dial
            label="Own heading"
            unit="°"
            value={heading.value ?? sample.pursuer.heading_deg}
            digits={3}
            correct={(value) => Number(formatHeading(value))}
            change={(value) => {
              heading.value = value;
            }}
            most={360}
            commit={(value) => {
              props.actions.ownHeading(value);
              heading.value = null;
            }}
          />
        </div>
      )}
    </Panel>
  );
}
