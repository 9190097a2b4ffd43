/** The plan in numbers: when, how far, which turns, how close, and what is proved of it. */

import { AlarmLine, Panel, Reading } from "../parts";
import type { Session } from "../session";
import type { LeastAhead, Numbers } from "../store/numbers";
import { countTurns, plannerName, proofSentence, STATE_NAMES, wordTitle } from "../store/reading";
import { formatClock, formatMiles } from "../units";
import type { LinkResult, PlanCard } from "../wire";

interface Given {
  session: Pick<Session, "flight" | "shown">;
  /** What is said of a path that is proposed: of its time, in place of when it joins, and beneath. */
  label?: string;
  note?: string;
  remark?: string;
}

export function PlanNumbers({ session, label, note, remark }: Given) {
  const { flight, shown } = session;
  const numbers = shown.numbers.value;
  const { sample, plan } = numbers;
  if (sample === null) {
    return (
      <Panel name="plan" title="Convergence">
        <p class="hint">
          {numbers.readAt === null ? "Waiting for the first position." : "The data are lost."}
        </p>
      </Panel>
    );
  }
  const isClose = sample.mode === "capture" || sample.mode === "follow";
  return (
    <Panel
      name="plan"
      scrolls
      title="Convergence"
      aside={<span class={`mode-name ${numbers.state}`}>{STATE_NAMES[numbers.state]}</span>}
      {...(numbers.alarm !== null && { alarm: numbers.alarm.level })}
    >
      <AlarmLine numbers={numbers} />
      {flight.read.value.result !== null ? (
        <Outcome ended={flight.read.value.result} />
      ) : (
        <Headline numbers={numbers} isJoined={sample.joined} label={label} note={note} />
      )}
      {plan !== null && remark !== undefined && <p class="why">{remark}</p>}
      <dl class="readings">
        {plan !== null && !isClose && <PathReadings plan={plan} numbers={numbers} />}
        <SpacingReadings numbers={numbers} isClose={isClose} />
        <SafetyReadings numbers={numbers} />
      </dl>
      {plan !== null && <p class="proof">{proofOf(plan.ideal ?? plan.plan)}</p>}
    </Panel>
  );
}

function proofOf({ optimality, time_to_converge_s }: PlanCard): string {
  return proofSentence(optimality, time_to_converge_s);
}

const HEADLINES: Partial<Record<Numbers["state"], string>> = {
  proposed: "Proposed, as flown",
  armed: "Accepted, as flown",
};
const FLOWN = "as the aircraft will really fly it: it rolls into its turns and brakes for the slot";

/** The one number that matters now. */
function Headline(props: {
  numbers: Numbers;
  isJoined: boolean;
  label: string | undefined;
  note: string | undefined;
}) {
  const { alarm, trouble, toJoin, joinsAt, separation, state } = props.numbers;
  if (trouble !== null && alarm?.level !== "alert") {
    return (
      <div class="headline caution">
        <span class="headline-label">{trouble.label}</span>
        <p>{trouble.sentence}</p>
      </div>
    );
  }
  if (toJoin !== "" && alarm?.level !== "alert") {
    return (
      <div class="headline">
        <span class="headline-label" title={FLOWN}>
          {props.label ?? HEADLINES[state] ?? "Time to join, as flown"}
        </span>
        <span class="headline-figure">{toJoin}</span>
        <span class="headline-note">{props.note ?? `joins at ${joinsAt}`}</span>
      </div>
    );
  }
  const tone = alarm === null ? "" : { alert: "lost", caution: "nearing" }[alarm.level];
  return (
    <div class={`headline ${tone}`}>
      <span class="headline-label">{props.isJoined ? "Joined" : "Separation"}</span>
      <span class="headline-figure">{separation}</span>
      <span class="headline-note">NM to the leader</span>
    </div>
  );
}

function Outcome(props: { ended: LinkResult }) {
  const { ended } = props;
  return (
    <div class="headline">
      <span class="headline-label">{ended.joined ? "Joined at" : "Ended, not joined"}</span>
      <span class="headline-figure">{formatClock(ended.join_time_s)}</span>
      <span class="headline-note">
        {ended.planned_time_s > 0 &&
          `planned ${formatClock(ended.planned_time_s)} from engaging · `}
        {ended.joined && ended.optimum_s > 0 && `fastest ${formatClock(ended.optimum_s)} · `}
        {formatMiles(ended.track_m)} NM
      </span>
    </div>
  );
}

function PathReadings(props: { plan: NonNullable<Numbers["plan"]>; numbers: Numbers }) {
  const { plan } = props.plan;
  const { nextTurn } = props.numbers;
  const turns = countTurns(plan);
  return (
    <>
      <Reading
        label="Path"
        title={wordTitle(plan.word)}
        value={plan.word}
        note={`${formatMiles(plan.length_m)} NM, ${turns} turn${turns === 1 ? "" : "s"}`}
      />
      <Reading
        label="Next turn"
        value={nextTurn?.size ?? "none"}
        {...(nextTurn !== null && { note: `in ${nextTurn.left}` })}
      />
    </>
  );
}

function SpacingReadings(props: { numbers: Numbers; isClose: boolean }) {
  const { slotDistance, separation, closureWords, spacingWords, crossTrackWords, alarm } =
    props.numbers;
  return (
    <>
      <Reading label="D required" value={slotDistance} unit="NM" />
      <Reading
        label="d now"
        value={separation}
        unit="NM"
        note={closureWords}
        {...(alarm !== null && { tone: alarm.level })}
      />
      {props.isClose && <Reading label="Spacing error" value={spacingWords} />}
      {props.isClose && <Reading label="Cross-track" value={crossTrackWords} />}
    </>
  );
}

/** When they are closest: how long until then, unless that is past, or once joined. */
function whenClosest({ when, left }: LeastAhead): string {
  return { ahead: `in ${left}`, passed: "passed", at_join: "once joined" }[when];
}

function SafetyReadings(props: { numbers: Numbers }) {
  const { nearestOther } = props.numbers;
  const { least, plan, leastSoFar, wasLost, minSeparation, margin, saving } = props.numbers;
  const known = props.numbers.isIntentKnown;
  return (
    <>
      {least !== null && (
        <Reading label="Least forecast" value={least.miles} unit="NM" note={whenClosest(least)} />
      )}
      {nearestOther !== null && (
        <Reading
          label="Nearest other"
          value={nearestOther.miles}
          unit="NM"
          note={`${nearestOther.ident} in ${nearestOther.left}${nearestOther.isByHeight ? ", kept by height" : ""}`}
        />
      )}
      {plan !== null && (
        <Reading
          label="Least proved"
          value={formatMiles(plan.plan.separation.proved_above_m)}
          unit="NM"
        />
      )}
      <Reading
        label="Least so far"
        value={leastSoFar}
        unit="NM"
        tone={wasLost ? "alert" : "value"}
        note={`${wasLost ? "LOST " : ""}(MIN ${minSeparation})`}
      />
      {margin !== "" && (
        <Reading label="Uncertain by" value={`± ${margin}`} unit="NM" note="kept beside MIN" />
      )}
      <Reading
        label="Leader intent"
        value={known === null ? "unknown" : known ? "YES" : "NO"}
        tone={known === true ? "value" : "plain"}
        {...(saving !== "" && { note: `known a minute ahead it saves up to ${saving}` })}
      />
      {plan !== null && (
        <Reading
          label="Planner"
          value={plannerName(plan.plan.planner)}
          note={planningTime(plan.plan.compute_ms)}
        />
      )}
    </>
  );
}

/** What planning took; a path that is kept is not planned anew. */
function planningTime(ms: number): string {
  return ms > 0 ? `${ms.toFixed(2)} ms` : "path kept";
}
