/** What the crew does with relative guidance: designate, accept, engage, disconnect; one step a button. */

import { late } from "../late";
import { Panel } from "../parts";
import { type Actions, isFlying, type Session } from "../session";
import type { Numbers } from "../store/numbers";
import type { Guidance } from "../store/states";
import type { Engagement } from "../wire";

const Switches = late(async () => (await import("./crew")).Switches, "");
const Selections = late(async () => (await import("./crew")).Selections, "");

/** What can be done in a state: the next step, and the way back. */
interface Steps {
  readonly says: string;
  readonly next: { readonly text: string; readonly to: Engagement } | null;
  readonly back: string;
}

/** Why a step is asked for that the crew has done before; "" if it has not. */
function againText({ state, lapsed, droppedAt }: Numbers): string {
  if (state !== "proposed") return "";
  if (droppedAt === "") return lapsed;
  return `Guidance was engaged until the leader was not heard of any more, at ${droppedAt}. Two steps engage it again: Accept, then Engage.`;
}

const STEPS: Record<Guidance, Steps> = {
  off: {
    says: "Join the leader in the least time, never closer than the minimum. Designate it: here, or by a click on it.",
    next: { text: "Designate", to: "designated" },
    back: "",
  },
  designated: { says: "Looking for a path to its slot.", next: null, back: "Cancel" },
  proposed: {
    says: "A path is proposed, dashed yellow. Nothing is flown yet.",
    next: { text: "Accept", to: "armed" },
    back: "Cancel",
  },
  armed: {
    says: "Accepted, dashed cyan. It waits for you.",
    next: { text: "Engage", to: "engaged" },
    back: "Cancel",
  },
  converge: { says: "Guidance commands the path.", next: null, back: "Disconnect" },
  capture: { says: "Guidance closes onto the leader's route.", next: null, back: "Disconnect" },
  follow: { says: "Guidance keeps the spacing.", next: null, back: "Disconnect" },
  escape: { says: "Guidance turns away from the leader.", next: null, back: "Disconnect" },
  infeasible: { says: "No path to its slot now; it is tried again.", next: null, back: "Cancel" },
  unable: { says: "No path to fly now; it is tried again.", next: null, back: "Disconnect" },
  data_lost: {
    says: "Nothing is heard of the leader. The autopilot holds the heading that you select.",
    next: null,
    back: "Cancel",
  },
};

export function Engage(props: { session: Session; actions: Actions }) {
  const { value: numbers } = props.session.shown.numbers;
  const again = againText(numbers);
  return (
    <Panel name="engage" title="Relative guidance" aside={<Switches {...props} />}>
      <p class={`hint ${again === "" ? "" : "again"}`}>{again === "" ? saysOf(numbers) : again}</p>
      <div class="row">
        <EngageButtons {...props} />
      </div>
      <Selections {...props} />
    </Panel>
  );
}

function saysOf({ state, sample }: Numbers): string {
  const { says } = STEPS[state];
  return sample?.autopilot === false ? says.replace("The autopilot holds", "Hold") : says;
}

/** The next step, and the way back. */
export function EngageButtons({ session, actions }: { session: Session; actions: Actions }) {
  const { state, readAt } = session.shown.numbers.value;
  const { next, back } = STEPS[state];
  const absent = readAt === null || !isFlying(session);
  return (
    <>
      <button
        type="button"
        class="primary grow"
        disabled={absent || next === null}
        onClick={() => next !== null && actions.engage(next.to)}
      >
        {next?.text ?? "Engage"}
      </button>
      <button
        type="button"
        class="grow"
        disabled={absent || back === ""}
        onClick={() => actions.engage("off")}
      >
        {back === "" ? "Cancel" : back}
      </button>
    </>
  );
}
