/** The leader's first turn by hand: where it begins, and the heading that it leads to. */

import { type Vector, windVector } from "../geometry";
import { bearing, type Place } from "../nd/view";
import { wrap180, wrap360 } from "../units";
import type { IntentPiece, PathPoint, TurnPiece } from "../wire";
import { leaderRoute } from "./leader-route";
import { BOUNDS, clamp, MOST_PIECES, type Situation } from "./situation";

/** Dragged across the heading before it by less than this, a turn goes to the other side [°]. */
const TURNS_OVER = 90;

interface FirstTurn {
  /** Its number among the pieces, and that of the straight before it; −1 if there is none. */
  readonly index: number;
  readonly straight: number;
  readonly piece: TurnPiece;
  /** Where its straight begins, where it begins, and where it ends. */
  readonly before: PathPoint;
  readonly begins: PathPoint;
  readonly ends: PathPoint;
}

/** Null where the leader declares no turn. */
export function firstTurn(situation: Situation): FirstTurn | null {
  const { intent } = situation.leader;
  const index = intent.findIndex((piece) => "direction" in piece);
  const piece = intent[index];
  if (piece === undefined || !("direction" in piece)) return null;
  const route = leaderRoute(situation, windVector(situation.wind));
  // the route has no segment for a change of level
  const flown = intent.slice(0, index).filter((each) => !("level_change" in each)).length;
  const straight = intent.slice(0, index).findLastIndex((each) => "straight_s" in each);
  const [before, turn] = [route[Math.max(0, flown - 1)], route[flown]];
  if (before === undefined || turn === undefined) return null;
  return { index, straight, piece, before: before.start, begins: turn.start, ends: turn.end };
}

/** How long the leader flies straight before its first turn [s]. */
export function straightBefore(situation: Situation): number {
  return firstTurn(situation)?.begins.t_s ?? 0;
}

/** The situation with its turn begun where a place lies along the leg before it. */
export function beginTurnAt(situation: Situation, place: Place): Situation {
  const turn = firstTurn(situation);
  if (turn === null) return situation;
  const ground = groundVelocity(situation);
  const [east, north] = [place.x_m - turn.before.x_m, place.y_m - turn.before.y_m];
  const speed = Math.max(1, Math.hypot(ground.x, ground.y));
  const along = (east * ground.x + north * ground.y) / speed;
  return withStraight(situation, Math.round(along / speed));
}

/** The same with so much more or less of the straight before it [s]. */
export function delayTurn(situation: Situation, by: number): Situation {
  const turn = firstTurn(situation);
  if (turn === null) return situation;
  return withStraight(situation, Math.round(turn.begins.t_s - turn.before.t_s) + by);
}

/** The straight before the first turn made so long [s]; one is put there if there is none. */
function withStraight(situation: Situation, duration: number): Situation {
  const turn = firstTurn(situation);
  const { intent } = situation.leader;
  if (turn === null) return situation;
  const straight: IntentPiece = { straight_s: clamp(duration, BOUNDS.piece) };
  const isThere = turn.straight >= 0;
  if (!isThere && (duration <= 0 || intent.length >= MOST_PIECES)) return situation;
  const pieces = isThere ? intent.with(turn.straight, straight) : [straight, ...intent];
  return { ...situation, leader: { ...situation.leader, intent: pieces } };
}

/** The situation with its first turn led to a heading [°]. */
export function leadTurnTo(situation: Situation, heading: number): Situation {
  const turn = firstTurn(situation);
  if (turn === null) return situation;
  const turned = wrap180(heading - turn.begins.heading_deg);
  const side = turned < 0 ? "left" : "right";
  const direction = Math.abs(turned) < TURNS_OVER ? side : turn.piece.direction;
  const piece = { ...turn.piece, turn_to_heading_deg: wrap360(Math.round(heading)), direction };
  const intent = situation.leader.intent.with(turn.index, piece);
  return { ...situation, leader: { ...situation.leader, intent } };
}

/** The same, pointed from where it ends at a place. */
export function leadTurnTowards(situation: Situation, place: Place): Situation {
  const turn = firstTurn(situation);
  return turn === null ? situation : leadTurnTo(situation, bearing(turn.ends, place));
}

function groundVelocity({ leader, wind }: Situation): Vector {
  const [psi, air] = [(leader.heading_deg * Math.PI) / 180, windVector(wind)];
  return {
    x: leader.tas_mps * Math.sin(psi) + air.x,
    y: leader.tas_mps * Math.cos(psi) + air.y,
  };
}
