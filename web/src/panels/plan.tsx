/** The plan in numbers: when, how far, which turns, how close, and what is proved of it. */

import {
  type Closest,
  closestApproach,
  flownPlan,
  isClosestAtJoin,
  nextTurn,
  timeToJoin,
} from "../committed";
import type { Flight } from "../flight";
import type { PairSample } from "../pair";
import { Panel, Reading } from "../parts";
import {
  closureText,
  countTurns,
  crossTrackText,
  MODE_NAMES,
  plannerName,
  proofSentence,
  spacingText,
} from "../reading";
import type { Session } from "../session";
import { formatClock, formatMiles } from "../units";
import type { LinkResult, PlanChanged } from "../wire";

export function PlanNumbers(props: { session: Session }) {
  const { flight, reading } = props.session;
  const sample = reading.value;
  const plan = flownPlan(flight);
  if (sample === null) {
    return (
      <Panel name="plan" title="Convergence">
        <p class="hint">
          {flight.sample.value === null ? "Waiting for the first position." : "The data are lost."}
        </p>
      </Panel>
    );
  }
  const engaged = sample.mode === "converge" && plan !== null;
  return (
    <Panel
      name="plan"
      title="Convergence"
      aside={<span class={`mode-name ${sample.mode}`}>{MODE_NAMES[sample.mode]}</span>}
    >
      {flight.ended.value !== null ? (
        <Outcome ended={flight.ended.value} />
      ) : (
        <Headline flight={flight} sample={sample} />
      )}
      <dl class="readings">
        {plan !== null && engaged && <PathReadings plan={plan} t={sample.t_s} />}
        <SpacingReadings flight={flight} sample={sample} engaged={engaged} />
        <SafetyReadings flight={flight} plan={plan} sample={sample} />
      </dl>
      {plan !== null && (
        <p class="proof">{proofSentence(plan.plan.optimality, plan.plan.time_to_converge_s)}</p>
      )}
    </Panel>
  );
}

/** The one number that matters now. */
function Headline(props: { flight: Flight; sample: PairSample }) {
  const { flight, sample } = props;
  const [unavailable, unable] = [flight.unavailable.value, flight.unable.value];
  if (unavailable !== null || unable !== null) {
    return (
      <div class="headline caution">
        <span class="headline-label">{unavailable === null ? "Unable" : "No plan"}</span>
        <p>{unavailable?.answer.message ?? unable?.message}</p>
      </div>
    );
  }
  const left = timeToJoin(flight);
  if (left !== null) {
    return (
      <div class="headline">
        <span class="headline-label">Time to converge</span>
        <span class="headline-figure">{formatClock(left)}</span>
        <span class="headline-note">joins at {formatClock(sample.t_s + left)}</span>
      </div>
    );
  }
  return (
    <div class="headline">
      <span class="headline-label">{sample.joined ? "Joined" : "Separation"}</span>
      <span class="headline-figure">{formatMiles(sample.separation_m)}</span>
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
        planned {formatClock(ended.planned_time_s)} · {formatMiles(ended.track_m)} NM
      </span>
    </div>
  );
}

function PathReadings(props: { plan: PlanChanged; t: number }) {
  const { plan, t } = props;
  const turns = countTurns(plan.plan);
  const next = nextTurn(plan, t);
  return (
    <>
      <Reading
        label="Path"
        value={plan.plan.word}
        note={`${formatMiles(plan.plan.length_m)} NM, ${turns} turn${turns === 1 ? "" : "s"}`}
      />
      <Reading
        label="Next turn"
        value={next === null ? "none" : `${next.size[0]} ${next.size.slice(1)}°`}
        {...(next !== null && { note: `in ${formatClock(next.in)}` })}
      />
    </>
  );
}

function SpacingReadings(props: { flight: Flight; sample: PairSample; engaged: boolean }) {
  const { flight, sample, engaged } = props;
  const required = flight.started.value?.slot_distance_m;
  return (
    <>
      <Reading
        label="D required"
        value={required === undefined ? "––" : formatMiles(required)}
        unit="NM"
      />
      <Reading
        label="d now"
        value={formatMiles(sample.separation_m)}
        unit="NM"
        note={closureText(sample.closure_mps)}
      />
      {!engaged && <Reading label="Spacing error" value={spacingText(sample.spacing_error_m)} />}
      {!engaged && <Reading label="Cross-track" value={crossTrackText(sample.cross_track_m)} />}
    </>
  );
}

/** When they are closest: how long until then, unless that is past, or once joined. */
function whenClosest(flight: Flight, closest: Closest, t: number): string {
  if (closest.at <= t) return "passed";
  return isClosestAtJoin(flight, closest) ? "once joined" : `in ${formatClock(closest.at - t)}`;
}

function SafetyReadings(props: { flight: Flight; plan: PlanChanged | null; sample: PairSample }) {
  const { flight, plan, sample } = props;
  const closest = closestApproach(flight);
  const minSeparation = flight.started.value?.min_separation_m ?? 0;
  const flown = sample.least_separation_m;
  const known = flight.route.value?.intent_known ?? null;
  return (
    <>
      {closest !== null && (
        <Reading
          label="Least forecast"
          value={formatMiles(closest.least)}
          unit="NM"
          note={whenClosest(flight, closest, sample.t_s)}
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
        value={formatMiles(flown)}
        unit="NM"
        tone={flown < minSeparation ? "alert" : "value"}
        note={`${flown < minSeparation ? "LOST " : ""}(MIN ${formatMiles(minSeparation)})`}
      />
      <Reading
        label="Leader intent"
        value={known === null ? "––" : known ? "YES" : "NO"}
        tone={known === false ? "plain" : "value"}
      />
      {plan !== null && (
        <Reading
          label="Planner"
          value={plannerName(plan.plan.planner)}
          note={`${plan.plan.compute_ms.toFixed(2)} ms`}
        />
      )}
    </>
  );
}
