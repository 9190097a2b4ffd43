/** Commands to the leader: a heading, a speed, and whether its intent is known. */

import { useSignal } from "@preact/signals";
import { Dial } from "../dial";
import { Choice, Icon, Panel } from "../parts";
import { type Actions, isFlying, type Session } from "../session";
import { ageOf } from "../store/states";
import { formatHeading, KT } from "../units";

export function LeaderControls(props: { session: Session; actions: Actions }) {
  const { session, actions } = props;
  const { sample, leader: heard } = session.shown.numbers.value;
  const leader = sample?.leader;
  const ident = session.flight.read.value.started?.leader.ident ?? "";
  // A leader that is called so needs not be called so twice.
  const named =
    ident.toLowerCase() === "leader" ? {} : { aside: <span class="ident">{ident}</span> };
  // A dial shows what the leader flies now until it is used.
  const heading = useSignal<number | null>(null);
  const knots = useSignal<number | null>(null);
  const headingNow = leader === undefined ? 0 : Math.round(leader.heading_deg);
  const knotsNow = leader === undefined ? 0 : Math.round(leader.tas_mps / KT);
  const selectedHeading = heading.value ?? headingNow;
  const selectedKnots = knots.value ?? knotsNow;
  const known = session.flight.read.value.route?.intent_known ?? null;
  const absent = leader === undefined || !isFlying(session);
  const isHeard = ageOf(sample?.leader_age_s ?? 0) === "fresh";
  return (
    <Panel name="leader" title="Leader" {...named}>
      <p class="caption">
        <span>Heading</span>
        <span>now {heard === null ? "––" : `${formatHeading(headingNow)}°`}</span>
      </p>
      <Dial
        label="Leader's heading"
        unit="°"
        value={selectedHeading}
        digits={3}
        correct={(value) => Number(formatHeading(value))}
        change={(value) => {
          heading.value = value;
        }}
        most={360}
        commit={(value) => actions.leaderHeading(value)}
      />
      <div class="row">
        <button
          type="button"
          class="grow"
          disabled={absent}
          onClick={() => actions.leaderHeading(selectedHeading, "left")}
        >
          <Icon name="left" />
          Left
        </button>
        <button
          type="button"
          class="grow"
          disabled={absent}
          onClick={() => actions.leaderHeading(selectedHeading)}
        >
          Shorter
        </button>
        <button
          type="button"
          class="grow"
          disabled={absent}
          onClick={() => actions.leaderHeading(selectedHeading, "right")}
        >
          Right
          <Icon name="right" />
        </button>
      </div>
      <p class="caption">
        <span>TAS</span>
        <span>now {heard === null ? "––" : `${knotsNow} kt`}</span>
        <button
          type="button"
          disabled={absent}
          onClick={() => actions.leaderSpeed(selectedKnots * KT)}
        >
          Set
        </button>
      </p>
      <Dial
        label="Leader's true airspeed in knots"
        unit="kt"
        value={selectedKnots}
        digits={3}
        correct={(value) => Math.max(0, value)}
        most={999}
        change={(value) => {
          knots.value = value;
        }}
        commit={(value) => actions.leaderSpeed(value * KT)}
      />
      <div class="row labelled">
        <span>Reports</span>
        <Choice
          label="Leader's reports"
          options={["received", "lost"]}
          chosen={leader === undefined ? null : isHeard ? "received" : "lost"}
          choose={(choice) => actions.setLeaderData(choice === "received")}
        />
      </div>
      <div class="row labelled">
        <span>Intent</span>
        <Choice
          label="Leader's intent"
          options={["known", "not known"]}
          chosen={known === null ? null : known ? "known" : "not known"}
          choose={(choice) => actions.setIntentKnown(choice === "known")}
        />
      </div>
    </Panel>
  );
}
