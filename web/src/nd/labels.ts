/**
 * Where labels stand: each beside its point, on the side it prefers, clear of the others.
 *
 * Greedy in the order of importance. A label keeps its side as long as that is nearly as good as the
 * best one, so that it does not hop; one that finds no room at all and may be left out is left out.
 */

import type { Colour } from "../store/colours";
import { DEG } from "../units";
import { type Box, overlap, type Point, within } from "./view";

interface LabelLine {
  readonly text: string;
  readonly colour: Colour;
}

export interface Label {
  readonly id: string;
  /** What it belongs to [px]. */
  readonly at: Point;
  readonly lines: readonly LabelLine[];
  /** The side it would like to stand on [deg right of up]. */
  readonly side: number;
  /** How far its nearest edge stands from the point [px]. */
  readonly gap: number;
  /** Size of the type [px]. */
  readonly size: number;
  /** Whether it may be left out where there is no room. */
  readonly optional: boolean;
}

/** What labels keep clear of. */
export interface Surroundings {
  /** Whether what stands at a point of the glass is seen. */
  readonly isSeen: (point: Point) => boolean;
  /** Symbols and readouts: no text over them. */
  readonly boxes: readonly Box[];
  /** Points along the lines of the map: better no text over them. */
  readonly points: readonly Point[];
}

/** Width of one character of the instrument's type, in its size. */
const CHARACTER = 0.63;
export const LINE_HEIGHT = 1.08;
const SIDES = [0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180] as const;
/** How much further out than its gap a label may go [px]. */
const REACHES = [0, 10, 26, 48] as const;

export interface Placement {
  /** The label's box relative to its point [px]. */
  readonly box: Box;
  /** Side and reach: what is kept from one time to the next. */
  readonly choice: string;
}

/** Finds a place for each label; those left out are missing from the answer. */
export function placeLabels(
  labels: readonly Label[],
  around: Surroundings,
  before: ReadonlyMap<string, Placement>,
): Map<string, Placement> {
  const placed = new Map<string, Placement>();
  const taken: Box[] = [...around.boxes];
  for (const label of labels) {
    let best: { place: Placement; cost: number } | null = null;
    for (const place of candidates(label)) {
      const cost = costOf(label, place, { ...around, boxes: taken }, before.get(label.id));
      if (best === null || cost < best.cost) best = { place, cost };
    }
    if (best === null || (label.optional && best.cost > CROWDED)) continue;
    placed.set(label.id, best.place);
    taken.push(shift(best.place.box, label.at));
  }
  return placed;
}

/** What is read apart stands apart: so much beside a label, and above and below it [px]. */
const ROOM = { x: 8, y: 4 } as const;

function widen({ x, y, width, height }: Box): Box {
  return { x: x - ROOM.x, y: y - ROOM.y, width: width + 2 * ROOM.x, height: height + 2 * ROOM.y };
}

/** Costs: to touch another label at all is worse than any choice of side. */
const TOUCHING = 400;
const COVERED = 6;
const CLOSE = 40;
const OUTSIDE = 400;
const ON_LINE = 16;
const TURNED = 24; // for half a turn from the preferred side
const FAR = 0.5; // for each pixel further out
const KEPT = 16;
const CROWDED = 90;

function* candidates(label: Label): Generator<Placement> {
  for (const reach of REACHES) {
    for (const turn of SIDES) {
      const side = label.side + turn;
      yield { box: boxOf(label, side, label.gap + reach), choice: `${turn} ${reach}` };
    }
  }
}

function boxOf(label: Label, side: number, gap: number): Box {
  const width = Math.max(...label.lines.map((each) => each.text.length)) * label.size * CHARACTER;
  const height = label.lines.length * label.size * LINE_HEIGHT;
  const [x, y] = [Math.sin(side * DEG), -Math.cos(side * DEG)];
  // From the middle of the box to its own edge in this direction, so that the gap is the same all round.
  const reach = Math.min(
    width / 2 / Math.max(Math.abs(x), 1e-9),
    height / 2 / Math.max(Math.abs(y), 1e-9),
  );
  return {
    x: x * (gap + reach) - width / 2,
    y: y * (gap + reach) - height / 2,
    width,
    height,
  };
}

function costOf(
  label: Label,
  place: Placement,
  around: Surroundings,
  before: Placement | undefined,
): number {
  const box = shift(place.box, label.at);
  const roomy = widen(box);
  const [turn, reach] = place.choice.split(" ").map(Number);
  let cost = (TURNED * Math.abs(turn ?? 0)) / 180 + FAR * (reach ?? 0);
  if (before?.choice === place.choice) cost -= KEPT;
  for (const other of around.boxes) {
    const area = overlap(box, other);
    if (area > 0) cost += TOUCHING + (COVERED * area) / label.size;
    else if (overlap(roomy, other) > 0) cost += CLOSE;
  }
  for (const point of around.points) if (within(box, point, 2)) cost += ON_LINE;
  for (const corner of corners(box)) if (!around.isSeen(corner)) cost += OUTSIDE;
  return cost;
}

function corners({ x, y, width, height }: Box): Point[] {
  return [
    { x, y },
    { x: x + width, y },
    { x, y: y + height },
    { x: x + width, y: y + height },
  ];
}

function shift(box: Box, by: Point): Box {
  return { ...box, x: box.x + by.x, y: box.y + by.y };
}
