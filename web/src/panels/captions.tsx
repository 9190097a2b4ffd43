/** Five captions for a first minute: each says what is seen now and what can be done, until it is done. */

import { useSignal } from "@preact/signals";
import { set } from "../parts";
import type { Session } from "../session";
import type { Guidance } from "../store/states";

const CAPTIONS = [
  "The white arrowhead is the leader; you are the yellow aircraft. Click the leader, or press D: it is to be joined.",
  "Dashed yellow leads to its slot: CNV says in what time, the dotted circle how close you come. Accept it, or press C.",
  "Dashed cyan: accepted, and not flown yet. Engage it, or press E.",
  "Green will be flown. The gate with the pennant is the slot, D behind the leader. ×10 makes it faster.",
  "Now let the leader turn: type its heading, and the path is made anew. PLAN is a map for situations of your own.",
] as const;

/** Which of them belongs to a state; those of flying are turned by hand. */
const AT: Record<Guidance, number> = {
  off: 0,
  designated: 1,
  proposed: 1,
  armed: 2,
  converge: 3,
  capture: 3,
  follow: 3,
  escape: 3,
  infeasible: 1,
  unable: 3,
  data_lost: 1,
};

/** What is said in its place where there is nothing of that kind to be seen. */
const INSTEAD: Partial<Record<Guidance, string>> = {
  designated: "A path to the leader's slot is looked for.",
  infeasible:
    "There is no path to the leader's slot: the panel says why. PLAN is a map, where you can move either of you.",
  unable: "There is no path to fly now, so the heading is held: the panel says why.",
  escape: "Own ship turns away to keep the minimum, and goes on to the slot when that is clear.",
  data_lost: "Nothing is heard of the leader, so you fly. Let its reports be received again.",
};

export function Captions(props: { session: Session }) {
  const { captions, shown } = props.session;
  const isTurned = useSignal(false);
  if (!captions.value || shown.numbers.value.readAt === null) return null;
  const { state } = shown.numbers.value;
  const [at, instead] = [AT[state], INSTEAD[state]];
  const isFlying = at === 3 && instead === undefined;
  const number = isFlying && isTurned.value ? 4 : at;
  return (
    <aside class="first-minute" aria-label="First steps">
      <b>{number + 1} of 5</b>
      <p>{instead ?? CAPTIONS[number]}</p>
      {isFlying && !isTurned.value && (
        <button type="button" onClick={set(isTurned, true)}>
          Next
        </button>
      )}
      <button
        type="button"
        class="quiet"
        aria-label="Close the first steps"
        onClick={set(captions, false)}
      >
        ×
      </button>
    </aside>
  );
}
