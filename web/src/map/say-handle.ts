/** What a handle is, and what it says, for those who do not see it. */

import type { Place } from "../nd/view";
import { formatClock, formatHeading, formatKnots, formatMiles, NM } from "../units";
import type { HandleName } from "./handles";
import { type OtherHandle, otherPart, sayOther, side } from "./other-handles";
import { BOUNDS, MOST_PIECES, type Situation } from "./situation";
import { firstTurn, straightBefore } from "./turn-handles";

/** How a handle is said, and its value as a number for those who do not see it. */
export interface Said {
  readonly label: string;
  readonly text: string;
  readonly value: number;
  readonly least: number;
  readonly most: number;
}

/** What a handle is and what it says now. */
export function sayHandle(name: HandleName, situation: Situation): Said {
  const { pursuer, leader, wind } = situation;
  const heading = (label: string, value: number): Said => ({
    label,
    text: `${formatHeading(value)} degrees`,
    value: Math.round(value),
    least: 0,
    most: 360,
  });
  const miles = (label: string, length: number): Said => ({
    label,
    text: `${formatMiles(length)} nautical miles`,
    value: Number((length / NM).toFixed(1)),
    least: 0,
    most: Math.floor(BOUNDS.distance[1] / NM),
  });
  const place = (label: string, { x_m, y_m }: Place): Said => ({
    label,
    text: `${side(x_m, "east", "west")}, ${side(y_m, "north", "south")}`,
    value: Math.round(x_m / NM),
    least: -540,
    most: 540,
  });
  const other = otherPart(name);
  if (other !== null) return sayOther(other, situation);
  switch (name as Exclude<HandleName, OtherHandle>) {
    case "own":
      return place("Own ship's place", pursuer);
    case "leader":
      return place("Leader's place", leader);
    case "own-heading":
      return heading("Own ship's heading", pursuer.heading_deg);
    case "leader-heading":
      return heading("Leader's heading", leader.heading_deg);
    case "turn": {
      const before = Math.round(straightBefore(situation));
      return {
        label: "Leader's turn: how long until it begins",
        text: `in ${formatClock(before)}`,
        value: before,
        least: 0,
        most: MOST_PIECES * BOUNDS.piece[1],
      };
    }
    case "turn-heading":
      return heading(
        "Leader's turn: to heading",
        firstTurn(situation)?.piece.turn_to_heading_deg ?? leader.heading_deg,
      );
    case "slot":
      return miles("Slot distance D", situation.slot_distance_m);
    case "ring":
      return miles("Minimum separation", situation.min_separation_m);
    case "wind":
      return {
        label: "Wind: up and down for its speed, left and right for its direction",
        text:
          wind.speed_mps > 0
            ? `from ${formatHeading(wind.from_deg)} degrees, ${formatKnots(wind.speed_mps)} knots`
            : "calm",
        value: Number(formatKnots(wind.speed_mps)),
        least: 0,
        most: Number(formatKnots(BOUNDS.wind[1])),
      };
  }
}
