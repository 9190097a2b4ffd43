/** Paths over the ground as SVG: true arcs and lines in calm air, finely sampled trochoids in wind. */

import { cutSegment, pointAlong, sampleTurn, type Vector } from "../geometry";
import { DEG } from "../units";
import type { PathSegment, TurnSegment } from "../wire";
import { distance, type Layout, type Place, round, toMap } from "./view";

/** How far a sampled turn may lie from the true one [px]. */
const TOLERANCE = 0.1;
/** An SVG arc command differs from its mirror image only below half a turn [deg]. */
const ARC_LIMIT = 120;

/** Draws segments one after another, as path data in map pixels. */
export function pathData(layout: Layout, segments: readonly PathSegment[], wind: Vector): string {
  const first = segments[0];
  if (first === undefined) return "";
  return `M${point(layout, first.start)}${segments
    .map((segment) => segmentData(layout, segment, wind))
    .join("")}`;
}

function segmentData(layout: Layout, segment: PathSegment, wind: Vector): string {
  switch (segment.kind) {
    case "turn":
      // a turn too small for any command still has its end
      return turnData(layout, segment, wind) || `L${point(layout, segment.end)}`;
    case "straight":
      return `L${point(layout, segment.end)}`;
    case "boundary":
      return [...segment.via, segment.end].map((each) => `L${point(layout, each)}`).join("");
  }
}

function turnData(layout: Layout, turn: TurnSegment, wind: Vector): string {
  const radius = turn.radius_m * layout.scale;
  if (wind.x === 0 && wind.y === 0) {
    const sweep = turn.direction === "right" ? 1 : 0; // y is down, so right is clockwise: sweep 1
    const count = Math.max(1, Math.ceil(turn.angle_deg / ARC_LIMIT));
    const span = (turn.end.t_s - turn.start.t_s) / count;
    return Array.from({ length: count }, (_, i) => {
      const end =
        i + 1 === count ? turn.end : pointAlong(turn, turn.start.t_s + span * (i + 1), wind);
      return `A${round(radius)} ${round(radius)} 0 0 ${sweep} ${point(layout, end)}`;
    }).join("");
  }
  // Sagitta r (1 − cos(δ/2)) = tolerance; halved since wind can bend the ground path more tightly.
  const step = Math.acos(1 - Math.min(1, TOLERANCE / Math.max(radius, TOLERANCE))) / DEG;
  return sampleTurn(turn, wind, Math.max(step, 0.5))
    .slice(1)
    .map((each) => `L${point(layout, each)}`)
    .join("");
}

/** Which segment is flown at `t` [s, the path's own clock]; their number when all are flown. */
export function segmentAt(segments: readonly PathSegment[], t: number): number {
  const index = segments.findIndex((segment) => t < segment.end.t_s);
  return index < 0 ? segments.length : index;
}

/** What is left of one segment after `t`, up to `until`, as path data. */
export function restData(
  layout: Layout,
  segment: PathSegment | undefined,
  wind: Vector,
  t: number,
  until = Number.POSITIVE_INFINITY,
): string {
  if (segment === undefined) return "";
  const rest = cutSegment(segment, t, until, wind);
  return rest === null ? "" : pathData(layout, [rest], wind);
}

/** How long a segment is drawn [px]; in wind a turn only about so, which is enough for its dashes. */
export function pixelLength(layout: Layout, segment: PathSegment): number {
  if (segment.kind === "turn") return segment.radius_m * segment.angle_deg * DEG * layout.scale;
  return distance(segment.start, segment.end) * layout.scale;
}

/** Places joined by straight lines; fewer than two are no line. */
export function polyline(layout: Layout, places: readonly Place[]): string {
  if (places.length < 2) return "";
  return `M${places.map((place) => point(layout, place)).join("L")}`;
}

export function line(layout: Layout, from: Place, to: Place): string {
  return `M${point(layout, from)}L${point(layout, to)}`;
}

function point(layout: Layout, place: Place): string {
  const { x, y } = toMap(layout, place);
  return `${round(x)} ${round(y)}`;
}
