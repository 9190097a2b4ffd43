/** The range that has all in sight that belongs there: the path ahead, the leader, the slot. */

import {
  bearing,
  type DisplayMode,
  layoutOf,
  offNose,
  onMap,
  type Place,
  type Pose,
  project,
  RANGES,
} from "./view";

export type Range = (typeof RANGES)[number];

/** How far from the edge all must be [px]: more before a smaller range is taken, so that it stays. */
const MARGIN = 24;
const ROOM = 64;
/** What is farther than this off the nose is behind: in ARC, no range shows much of it [deg]. */
const BEHIND = 100;

/** For a leader that is behind, the range may be so many times what the rest needs. */
const FOR_LEADER = 2;

/**
 * The smallest range with all places on the map; the present one as long as it is nearly that. What is
 * behind does not count in ARC, but for the leader, the first place, where that costs little: else it
 * has its symbol on the edge.
 */
export function fittingRange(
  mode: DisplayMode,
  pose: Pose,
  places: readonly Place[],
  present: Range,
): Range {
  const isAhead = (place: Place) => isBeforeNose(mode, pose, place);
  const ahead = places.filter(isAhead);
  const [leader] = places;
  const enough = rangeOf(mode, pose, ahead, places, present);
  if (leader === undefined || isAhead(leader)) return enough;
  const both = rangeOf(mode, pose, [leader, ...ahead], places, present);
  return ahead.length === 0 || both <= FOR_LEADER * enough ? both : enough;
}

function isBeforeNose(mode: DisplayMode, pose: Pose, place: Place): boolean {
  return mode === "ROSE" || Math.abs(offNose(pose, bearing(pose, place))) < BEHIND;
}

/** Whether all places that a range can show are on the map. */
export function areInSight(
  mode: DisplayMode,
  pose: Pose,
  places: readonly Place[],
  range: Range,
): boolean {
  const layout = layoutOf(mode, range);
  return places
    .filter((place) => isBeforeNose(mode, pose, place))
    .every((place) => onMap(layout, project(layout, pose, place)));
}

/** The circle of least separation is at least so large where it must be told apart [px]. */
const SMALLEST_CIRCLE = 20;

/** The largest range in which the circle of least separation [m] is still large enough to steer by. */
export function largestLegible(mode: DisplayMode, minSeparation: number): Range {
  const isLegible = (range: Range) =>
    minSeparation * layoutOf(mode, range).scale >= SMALLEST_CIRCLE;
  return RANGES.findLast(isLegible) ?? RANGES[0];
}

/** Between two steps of the range, and where what is near is off the map [s]. */
const STEP_AFTER = 4;
const STEP_AT_ONCE = 1;

/**
 * The range one step nearer to the one that fits: by single steps with some seconds between, so that a
 * plan that changes does not throw the picture about.
 */
export function stepToward(
  fitting: Range,
  present: Range,
  { since, isUrgent }: { readonly since: number; readonly isUrgent: boolean },
): Range {
  if (since < (isUrgent ? STEP_AT_ONCE : STEP_AFTER)) return present;
  const at = RANGES.indexOf(present);
  return RANGES[at + Math.sign(RANGES.indexOf(fitting) - at)] ?? present;
}

/** The smallest range with what is wanted of all places. */
function rangeOf(
  mode: DisplayMode,
  pose: Pose,
  wanted: readonly Place[],
  places: readonly Place[],
  present: Range,
): Range {
  const fits = (range: Range, margin: number) => {
    const layout = layoutOf(mode, range);
    return wanted.every((place) => onMap(layout, project(layout, pose, place), margin));
  };
  const enough = RANGES.find((range) => fits(range, MARGIN)) ?? largestUseful(mode, pose, places);
  if (enough >= present) return enough;
  return RANGES.find((range) => range >= enough && fits(range, ROOM)) ?? enough;
}

/** Where no range shows all: the smallest one that shows as many as the largest does. */
function largestUseful(mode: DisplayMode, pose: Pose, places: readonly Place[]): Range {
  const seen = (range: Range) => {
    const layout = layoutOf(mode, range);
    return places.filter((place) => onMap(layout, project(layout, pose, place), MARGIN)).length;
  };
  const most = Math.max(...RANGES.map(seen));
  return RANGES.find((range) => seen(range) === most) ?? 40;
}
