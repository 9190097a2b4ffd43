/** Shows two flights beside each other: loaded when that is first asked for. */

import type { Actions, Recording, Session } from "../session";
import { fetchReference, readCompared } from "./opening";
import { splitReference } from "./references";

/** Two flights are shown first this long after the leader has begun to turn: they begin to differ [s]. */
const TURNING = 6;

/** What the page does for it. */
export interface Means {
  readonly session: Session;
  say(kind: "sending" | "done" | "refused", text: string): void;
  /** Shows a recording in place of the flight; false if it is refused. */
  replay(file: Blob, about: Pick<Recording, "id" | "from">): Promise<boolean>;
  seek(t: number): void;
  /** Shows some flight where there is none to compare. */
  instead(): Promise<void>;
}

export interface Comparing extends Pick<Actions, "endComparison"> {
  /** Shows two flights beside each other, at flight time `t` [s], or else when the leader turns. */
  compare(first: string, other: string, t: number | null): Promise<void>;
  /** Shows another flight, or a recording of the user's own, beside the one that is shown. */
  compareWith(source: string | File): Promise<void>;
}

export function createComparing({ session, say, replay, seek, instead }: Means): Comparing {
  return {
    async compare(first, other, t) {
      const since = performance.now();
      const wait = () => {
        const seconds = Math.round((performance.now() - since) / 1000);
        say("sending", `Flying both to their end… ${seconds === 0 ? "" : `${seconds} s`}`);
      };
      wait();
      const waiting = setInterval(wait, 1000);
      const [shown, beside] = await Promise.all([fetchReference(first), readCompared(other)]);
      clearInterval(waiting);
      const refused = [shown, beside].find((each) => each.kind === "refused");
      if (shown.kind === "refused" || beside.kind === "refused") {
        noteComparison([]);
        const isEmpty = session.status.value === null && session.recording.value === null;
        if (isEmpty) await instead();
        say("refused", refused?.kind === "refused" ? refused.sentence : "");
        return;
      }
      const [kind, id] = splitReference(first);
      if (!(await replay(shown.value, { id, from: kind === "record" ? "record" : "scenario" })))
        return;
      session.comparison.other.value = beside.compared;
      noteComparison(kind === "record" ? [other] : [first, other]);
      const turn = session.history().events.find(({ kind }) => kind === "leader_changed");
      if (t !== null || turn !== undefined) seek(t ?? (turn?.t_s ?? 0) + TURNING);
      say("done", "Both are shown: one solid, the other dashed.");
    },
    async compareWith(source) {
      say("sending", "Reading the other flight…");
      const read = await readCompared(source);
      if (read.kind === "refused") {
        say("refused", read.sentence);
        return;
      }
      session.comparison.other.value = read.compared;
      noteComparison(read.compared.reference === null ? [] : [read.compared.reference]);
      say("done", `Beside it: ${read.compared.title}, dashed.`);
    },
    endComparison() {
      session.comparison.other.value = null;
      noteComparison([]);
    },
  };
}

/** Notes in the address what is compared. */
function noteComparison(references: readonly string[]): void {
  const address = new URL(location.href);
  if (references.length === 0) address.searchParams.delete("compare");
  else address.searchParams.set("compare", references.join(","));
  history.replaceState(history.state, "", address);
}
