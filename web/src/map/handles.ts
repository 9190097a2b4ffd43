/** What can be taken hold of on the map: where it is, what a drag or a key makes of the situation. */

import { type Vector, windVector } from "../geometry";
import {
  bearing,
  distance,
  type Layout,
  type Place,
  type Point,
  type Pose,
  project,
} from "../nd/view";
import { DEG, KT, NM, wrap360 } from "../units";
import { leaderRoute, slotNow } from "./leader-route";
import {
  dragOther,
  keyOther,
  type OtherHandle,
  otherHandles,
  otherPart,
  pointOfOther,
  towards,
} from "./other-handles";
import { type Situation, stepMiles } from "./situation";
import { beginTurnAt, delayTurn, firstTurn, leadTurnTo, leadTurnTowards } from "./turn-handles";

export const HANDLES = [
  "ring",
  "slot",
  "leader",
  "leader-heading",
  "turn",
  "turn-heading",
  "own",
  "own-heading",
  "wind",
] as const;
type OwnHandle = (typeof HANDLES)[number];
export type HandleName = OwnHandle | OtherHandle;

/** Those that a situation has: a leader that declares no turn has none to be dragged. */
export function handlesOf(situation: Situation): readonly HandleName[] {
  const own =
    firstTurn(situation) === null
      ? HANDLES.filter((name) => name !== "turn" && name !== "turn-heading")
      : HANDLES;
  return [...otherHandles(situation), ...own];
}

/** How far before an aircraft the handle of its heading stands [px]. */
const STICK = 62;
/** The wind's dial: its middle, its radius, and what the rim stands for. */
export const DIAL = { x: 74, y: 74, radius: 46, most: 100 * KT } as const;
/** Below this it is calm [m/s]: the middle of the dial. */
const CALM_BELOW = 2 * KT;

function slotOf(situation: Situation) {
  const wind = windVector(situation.wind);
  return slotNow(situation, leaderRoute(situation, wind), wind);
}

/** Where a handle is on the glass [px]. */
export function handlePoint(
  name: HandleName,
  situation: Situation,
  layout: Layout,
  middle: Pose,
): Point {
  const { pursuer, leader, wind } = situation;
  const at = (place: Place) => project(layout, middle, place);
  const other = otherPart(name);
  if (other !== null) return pointOfOther(other, situation, { layout, middle, stick: STICK });
  switch (name as OwnHandle) {
    case "own":
      return at(pursuer);
    case "leader":
      return at(leader);
    case "own-heading":
      return towards(at(pursuer), pursuer.heading_deg, STICK);
    case "leader-heading":
      return towards(at(leader), leader.heading_deg, STICK);
    case "turn":
      return at(firstTurn(situation)?.begins ?? leader);
    case "turn-heading": {
      const end = firstTurn(situation)?.ends ?? leader;
      return towards(at(end), end.heading_deg, STICK);
    }
    case "slot":
      return at(slotOf(situation).point);
    case "ring":
      return towards(
        at(leader),
        leader.heading_deg + 90,
        situation.min_separation_m * layout.scale,
      );
    case "wind":
      return towards(
        DIAL,
        wind.from_deg,
        (DIAL.radius * Math.min(wind.speed_mps, DIAL.most)) / DIAL.most,
      );
  }
}

/** The situation with a handle moved to a place; `glass` is the same on the glass [px]. */
export function dragHandle(
  name: HandleName,
  situation: Situation,
  place: Place,
  glass: Point,
): Situation {
  const { pursuer, leader } = situation;
  const to = { x_m: place.x_m, y_m: place.y_m };
  const other = otherPart(name);
  if (other !== null) return dragOther(other, situation, place);
  switch (name as OwnHandle) {
    case "own":
      return { ...situation, pursuer: { ...pursuer, ...to } };
    case "leader":
      return { ...situation, leader: { ...leader, ...to } };
    case "own-heading":
      return {
        ...situation,
        pursuer: { ...pursuer, heading_deg: Math.round(bearing(pursuer, place)) },
      };
    case "leader-heading":
      return {
        ...situation,
        leader: { ...leader, heading_deg: Math.round(bearing(leader, place)) },
      };
    case "turn":
      return beginTurnAt(situation, place);
    case "turn-heading":
      return leadTurnTowards(situation, place);
    case "slot":
      return withSlot(situation, along(slotOf(situation), place));
    case "ring":
      return withLimit(situation, distance(leader, place));
    case "wind":
      return { ...situation, wind: windAt(glass) };
  }
}

/** How far behind the leader's place on its final track a place is [m]. */
function along({ origin, ahead }: { origin: Vector; ahead: Vector }, place: Place): number {
  return (origin.x - place.x_m) * ahead.x + (origin.y - place.y_m) * ahead.y;
}

/** D in tenths of a mile, no less than d_min. */
function withSlot(situation: Situation, length: number): Situation {
  const wanted = Math.max(length, situation.min_separation_m);
  return {
    ...situation,
    slot_distance_m: Math.max(stepMiles(wanted, 0), situation.min_separation_m),
  };
}

/** d_min in tenths of a mile, no more than D. */
function withLimit(situation: Situation, length: number): Situation {
  const wanted = Math.min(Math.max(0, length), situation.slot_distance_m);
  return {
    ...situation,
    min_separation_m: Math.min(stepMiles(wanted, 0), situation.slot_distance_m),
  };
}

function windAt({ x, y }: Point): Situation["wind"] {
  const [east, north] = [x - DIAL.x, DIAL.y - y];
  const speed = Math.min(1, Math.hypot(east, north) / DIAL.radius) * DIAL.most;
  if (speed < CALM_BELOW) return { from_deg: 0, speed_mps: 0 };
  const from = wrap360(Math.round(Math.atan2(east, north) / DEG));
  return { from_deg: from, speed_mps: Math.round(speed / KT) * KT };
}

const ARROWS: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** The situation after a key on a handle; null if the key is not its. Shift makes the finer step. */
export function keyHandle(
  name: HandleName,
  situation: Situation,
  key: string,
  isFine: boolean,
): Situation | null {
  const arrow = ARROWS[key];
  if (arrow === undefined) return null;
  const [right, up] = arrow;
  const { pursuer, leader, wind } = situation;
  const move = <T extends Place>(aircraft: T): T => {
    const step = (isFine ? 0.1 : 1) * NM;
    return { ...aircraft, x_m: aircraft.x_m + right * step, y_m: aircraft.y_m + up * step };
  };
  const turn = <T extends { readonly heading_deg: number }>(aircraft: T): T => ({
    ...aircraft,
    heading_deg: Math.round(aircraft.heading_deg) + (right + up) * (isFine ? 1 : 5),
  });
  const miles = (right + up) * (isFine ? 0.1 : 0.5);
  const other = otherPart(name);
  if (other !== null) return keyOther(other, situation, arrow, isFine);
  switch (name as OwnHandle) {
    case "own":
      return { ...situation, pursuer: move(pursuer) };
    case "leader":
      return { ...situation, leader: move(leader) };
    case "own-heading":
      return { ...situation, pursuer: turn(pursuer) };
    case "leader-heading":
      return { ...situation, leader: turn(leader) };
    case "turn":
      return delayTurn(situation, (right + up) * (isFine ? 1 : 10));
    case "turn-heading": {
      const heading = firstTurn(situation)?.piece.turn_to_heading_deg ?? 0;
      return leadTurnTo(situation, Math.round(heading) + (right + up) * (isFine ? 1 : 5));
    }
    case "slot":
      return withSlot(situation, stepMiles(situation.slot_distance_m, miles));
    case "ring":
      return withLimit(situation, stepMiles(situation.min_separation_m, miles));
    case "wind": {
      const [knots, degrees] = isFine ? [1, 1] : [5, 10];
      const speed = Math.max(0, Math.round(wind.speed_mps / KT) + up * knots) * KT;
      return {
        ...situation,
        wind: { from_deg: wind.from_deg + right * degrees, speed_mps: speed },
      };
    }
  }
}
