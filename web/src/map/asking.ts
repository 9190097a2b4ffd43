/**
 * Asks the service as the map is edited: one question at a time, always about the newest situation, so
 * that the picture follows the finger and no old answer overtakes a new one.
 */

import { computed, effect, untracked } from "@preact/signals";
import { type Answer, drawArea, planSituation } from "../api";
import type { Session } from "../session";
import { inPageUnits } from "../units";
import type { AreaRequest } from "../wire";
import { type Editor, halfExtent, showAll } from "./editor";
import { BOUNDS, bodyOf, clamp, type Situation, settle } from "./situation";
import type { Thumb } from "./thumbs";

/** So long after a question what is shown still passes for its answer; then it is dimmed [ms]. */
const LATE = 150;
/** A service that does not answer is asked again [ms]. */
const ASK_AGAIN = 3000;
/** What a plan may take under the hand, and at rest [ms]. */
const QUICK = 80;
const THOROUGH = 2000;
/** The area is drawn finely once the hand has rested for so long [ms]. */
const REST = 250;
/** Nodes of its grid along each side, under the hand and at rest. */
const NODES = { moving: 28, resting: 120 } as const;

/** Follows the map while it is shown. */
export function followMap(session: Pick<Session, "ndMode" | "map" | "firstStart">): void {
  const { ndMode, map, firstStart } = session;
  let thorough: ReturnType<typeof setTimeout> | undefined;
  const askPlan = createAsker(
    () => map.situation.peek(),
    async (situation) => {
      const answer = await planSituation(bodyOf(situation), QUICK);
      clearTimeout(thorough);
      if (!isOptimal(answer)) thorough = setTimeout(() => void askMore(map, situation), REST);
      return takePlan(map, situation, answer);
    },
    () => {
      map.isLate.value = true;
    },
  );
  effect(() => {
    if (ndMode.value !== "PLAN") return;
    void map.situation.value;
    untracked(askPlan);
  });

  // Own ship's place does not matter to the area: while that is dragged, it stays as it is.
  const question = computed(() => (map.hasArea.value ? areaQuestion(map) : ""));
  let isResting = true;
  const askArea = createAsker(
    () => {
      if (question.peek() === "") return "";
      return `${question.peek()} ${isResting ? NODES.resting : NODES.moving}`;
    },
    async (asked) => {
      if (asked === "") {
        map.area.value = null;
        return 0;
      }
      const [body = "", nodes] = asked.split(" ");
      const sides = { columns: Number(nodes), rows: Number(nodes) };
      const answer = await drawArea({ ...(JSON.parse(body) as AreaRequest), ...sides });
      map.area.value = answer.kind === "done" ? { asked, answer: answer.value } : null;
      return againIn(answer);
    },
    () => {
      map.area.value = null;
    },
  );
  const askThumbs = createThumbAsker(map, () => ndMode.peek() === "PLAN");
  effect(() => {
    if (ndMode.value === "PLAN") untracked(askThumbs);
  });

  let resting: ReturnType<typeof setTimeout> | undefined;
  effect(() => {
    if (ndMode.value !== "PLAN") return;
    if (firstStart.value?.warm.areas === false) return; // it is asked when they are ready
    void question.value;
    untracked(() => {
      isResting = false;
      clearTimeout(resting);
      resting = setTimeout(() => {
        isResting = true;
        askArea();
      }, REST);
      askArea();
    });
  });
}

/** Asks for the plans of the gallery, one after another and each until it is answered, on the map. */
function createThumbAsker(map: Editor, isShown: () => boolean): () => void {
  let isAsking = false;
  async function ask({ entry, answered }: Thumb): Promise<number> {
    const situation = settle(entry.situation);
    const answer = await planSituation(bodyOf(situation), THOROUGH);
    if (answer.kind === "done") answered.value = { situation, answer: answer.value };
    return againIn(answer);
  }
  async function run(): Promise<void> {
    if (isAsking) return;
    isAsking = true;
    for (const thumb of map.thumbs.peek()) {
      let again = 1;
      while (again > 0 && thumb.answered.value === null && isShown()) {
        again = await ask(thumb);
        // A first start answers no plan until that is prepared, and says when to ask again.
        if (again > 0) await new Promise((resolve) => setTimeout(resolve, again));
      }
    }
    isAsking = false;
  }
  return () => void run();
}

/** Whether no more time would find a better plan. */
function isOptimal(answer: Awaited<ReturnType<typeof planSituation>>): boolean {
  if (answer.kind !== "done") return true;
  const { value } = answer;
  return value.status === "planned"
    ? value.optimality.proof === "relaxation"
    : value.reason !== "deadline" && value.reason !== "separation_unavoidable";
}

/** Asks for the plan of what has come to rest with more time, where that may help. */
async function askMore(map: Editor, situation: Situation): Promise<void> {
  if (map.situation.value !== situation) return;
  const answer = await planSituation(bodyOf(situation), THOROUGH);
  if (map.situation.value === situation) takePlan(map, situation, answer);
}

/** How long to wait before the same is asked again [ms]; 0 when it is answered for good. */
function againIn(answer: Answer<unknown>): number {
  if (answer.kind === "done") return 0;
  if (answer.retryAfter !== undefined) return 1000 * answer.retryAfter;
  return answer.status === 0 ? ASK_AGAIN : 0;
}

function takePlan(
  map: Editor,
  situation: Situation,
  answer: Awaited<ReturnType<typeof planSituation>>,
): number {
  map.isLate.value = false;
  if (answer.kind === "done") {
    map.refusal.value = "";
    map.answered.value = { situation, answer: answer.value };
    if (map.isToFit.value && map.situation.value === situation) {
      map.isToFit.value = false;
      showAll(map);
    }
  } else {
    map.refusal.value = inPageUnits(answer.sentence);
    map.answered.value = null;
  }
  return againIn(answer);
}

/** Asks until the newest question is answered; `expire` is called when that takes too long. */
function createAsker<T>(
  newest: () => T,
  ask: (question: T) => Promise<number>,
  expire: () => void,
): () => void {
  let isAsking = false;
  let settled: T | undefined;
  async function run(): Promise<void> {
    if (isAsking) return;
    isAsking = true;
    let question = newest();
    while (question !== settled) {
      const timer = setTimeout(expire, LATE);
      const again = await ask(question);
      clearTimeout(timer);
      if (again === 0) settled = question;
      else await new Promise((resolve) => setTimeout(resolve, again));
      question = newest();
    }
    isAsking = false;
  }
  return () => void run();
}

/** What is asked of the area, but for how finely: text without a blank, so that it can be compared. */
function areaQuestion(map: Editor): string {
  const situation = map.situation.value;
  const body = bodyOf({
    ...situation,
    pursuer: { ...situation.pursuer, x_m: 0, y_m: 0 },
  });
  const { x_m, y_m } = map.centre.value;
  const half = halfExtent(map.range.value);
  const [east, north] = [within(x_m, half), within(y_m, half)];
  if (Math.min(east.length, north.length) < SMALLEST_AREA) return "";
  const asked: AreaRequest = {
    situation: body,
    x_m: east.middle,
    y_m: north.middle,
    width_m: east.length,
    height_m: north.length,
  };
  return JSON.stringify(asked);
}

/** A narrower area is not drawn [m]. */
const SMALLEST_AREA = 2_000;

/** The part of an interval that lies within the bounds of what is planned, in even metres. */
function within(middle: number, half: number): { middle: number; length: number } {
  const [from, to] = [clamp(middle - half, BOUNDS.position), clamp(middle + half, BOUNDS.position)];
  const reach = Math.floor((to - from) / 2);
  return { middle: Math.ceil(from) + reach, length: 2 * reach };
}

/** Whether a part of what is seen lies beyond what is planned, so that no area is drawn there. */
export function isAreaCut(map: Editor): boolean {
  const half = halfExtent(map.range.value);
  const { x_m, y_m } = map.centre.value;
  return Math.max(Math.abs(x_m), Math.abs(y_m)) + half > BOUNDS.position[1];
}
