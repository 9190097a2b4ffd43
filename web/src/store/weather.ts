/** Weather cells: where each is at an instant, as all places near the hull of its corners. */

import type { Vector } from "../geometry";
import type { CellCard } from "../wire";
import { alertOn } from "./traffic";
import type { Moment } from "./types";

export interface Cell {
  readonly ident: string;
  /** Counter-clockwise; one alone is the middle of a disc. World: x east, y north [m]. */
  readonly corners: readonly Vector[];
  /** So far round the hull of the corners it reaches [m]. */
  readonly radius: number;
  /** The same a while later; null where that hardly differs. */
  readonly later: Pick<Cell, "corners" | "radius"> | null;
  readonly urgency: "none" | "caution" | "warning";
}

/** How far ahead a cell is shown [s]; what moves and grows by less than this until then stands still [m]. */
export const AHEAD = 300;
const LEAST_CHANGE = 500;

export function cellsOf(flight: Moment): Cell[] {
  return (flight.started?.cells ?? []).map((card) => {
    const { ident, east_mps, north_mps, growth_mps } = card;
    const change = AHEAD * (Math.hypot(east_mps, north_mps) + growth_mps);
    const level = alertOn(flight, ident)?.level;
    return {
      ident,
      ...cellAt(card, flight.t),
      later: change < LEAST_CHANGE ? null : cellAt(card, flight.t + AHEAD),
      urgency: level === "caution" || level === "warning" ? level : "none",
    };
  });
}

/** Corners and reach of a cell at flight time `t` [s]. */
export function cellAt(card: CellCard, t: number): Pick<Cell, "corners" | "radius"> {
  const { x_m, y_m, radius_m, east_mps, north_mps, growth_mps } = card;
  return {
    corners: x_m.map((x, k) => ({ x: x + east_mps * t, y: (y_m[k] ?? 0) + north_mps * t })),
    radius: radius_m + growth_mps * Math.max(0, t),
  };
}

/** Its edge as a polygon, counter-clockwise: round corners become chords of `step` [deg]. */
export function edgeOf({ corners, radius }: Pick<Cell, "corners" | "radius">, step = 15): Vector[] {
  const count = corners.length;
  if (radius === 0) return [...corners];
  return corners.flatMap((corner, k) => {
    const [before, after] = [corners[(k + count - 1) % count], corners[(k + 1) % count]];
    if (before === undefined || after === undefined) return [];
    const from = count === 1 ? 0 : outward(before, corner);
    const whole = count === 1 ? 360 : (outward(corner, after) - from + 720) % 360;
    const chords = Math.max(1, Math.ceil(whole / step));
    return Array.from({ length: chords + (count === 1 ? 0 : 1) }, (_, i) => {
      const angle = ((from + (whole * i) / chords) * Math.PI) / 180;
      return { x: corner.x + radius * Math.cos(angle), y: corner.y + radius * Math.sin(angle) };
    });
  });
}

/** The direction out of an edge of a counter-clockwise polygon [deg counter-clockwise from east]. */
function outward(from: Vector, to: Vector): number {
  return (Math.atan2(to.y - from.y, to.x - from.x) * 180) / Math.PI - 90;
}
