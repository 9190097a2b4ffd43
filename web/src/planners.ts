/** Four planners side by side: what each would fly from this instant on, asked for while that is open. */

import {
  computed,
  effect,
  type ReadonlySignal,
  type Signal,
  signal,
  untracked,
} from "@preact/signals";
import { comparePlanners } from "./api";
import type { Rival } from "./store/shown";
import type { Flight } from "./store/types";
import type { ComparedPlanner, PlannerVerdict } from "./wire";

/** In the order in which they are shown. */
export const PLANNERS: readonly ComparedPlanner[] = [
  "exact",
  "network",
  "regular_dp",
  "printed_network",
];

/** What the planners say of one instant. */
export interface Compared {
  /** Flight time [s]: their paths begin then. */
  readonly t: number;
  readonly verdicts: readonly PlannerVerdict[];
}

export interface Planners {
  readonly isOpen: Signal<boolean>;
  /** Whose path is drawn strongest. */
  readonly chosen: Signal<ComparedPlanner>;
  readonly compared: Signal<Compared | null>;
  /** The same to be drawn. */
  readonly rivals: ReadonlySignal<readonly Rival[]>;
  /** Why there is no answer, in a sentence; "" if there is one. */
  readonly trouble: Signal<string>;
}

/** They are asked anew this often, if the flight has gone on [ms]. */
export const ASK_EVERY = 5000;

export function createPlanners(): Planners {
  const chosen = signal<ComparedPlanner>("exact");
  const compared = signal<Compared | null>(null);
  const rivals = computed(() =>
    (compared.value?.verdicts ?? [])
      .filter(({ segments }) => segments.length > 0)
      .map(({ planner, segments, status }) => ({
        planner,
        segments,
        isFlyable: status === "planned",
        isChosen: planner === chosen.value,
      })),
  );
  return { isOpen: signal(false), chosen, compared, rivals, trouble: signal("") };
}

/** Asks while the comparison is open; what it says of another flight or instant is taken away. */
export function followPlanners(planners: Planners, flight: Flight, ask = comparePlanners): void {
  let timer: ReturnType<typeof setInterval> | undefined;
  let asked = Number.NaN;
  async function askNow(): Promise<void> {
    const { t } = flight.moment.peek();
    const pose = { moment: signal(flight.moment.peek()) };
    if (t === asked) return;
    asked = t;
    const [{ situationOf }, { bodyOf }] = await Promise.all([
      import("./map/from-flight"),
      import("./map/situation"),
    ]);
    const situation = situationOf(pose);
    if (situation === null) {
      asked = Number.NaN;
      return;
    }
    const answer = await ask(bodyOf(situation));
    if (!planners.isOpen.peek()) return;
    const isPreparing =
      answer.kind === "done" && answer.value.planners.some(({ status }) => status === "preparing");
    if (answer.kind !== "done" || isPreparing) asked = Number.NaN; // again, in a while
    planners.trouble.value = answer.kind === "done" ? "" : answer.sentence;
    planners.compared.value =
      answer.kind === "done" ? { t, verdicts: answer.value.planners } : null;
  }
  effect(() => {
    void flight.id.value;
    clearInterval(timer);
    planners.compared.value = null;
    asked = Number.NaN;
    if (!planners.isOpen.value) return;
    untracked(() => void askNow());
    timer = setInterval(() => void askNow(), ASK_EVERY);
  });
}
