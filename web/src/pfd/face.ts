/** Where all stands on the instrument's face of 640 × 600 [px], and how far it moves. */

import { FT, KT, NM, wrap180 } from "../units";
import type { Attitude } from "./attitude";

export const FACE = { width: 640, height: 600 } as const;

/** The attitude sphere: its window and its middle. */
export const BALL = { x: 112, y: 46, width: 356, height: 380, round: 64 } as const;
export const MIDDLE = { x: BALL.x + BALL.width / 2, y: BALL.y + BALL.height / 2 } as const;
/** The bank scale's radius. */
export const ARC = 160;

/** Rungs of pitch are seen in a round window within that. */
const RUNGS_IN = ARC - 24;
export const LADDER = {
  x: MIDDLE.x - RUNGS_IN,
  y: MIDDLE.y - RUNGS_IN,
  width: 2 * RUNGS_IN,
  height: 2 * RUNGS_IN,
  round: RUNGS_IN,
} as const;

/** Tapes; what is marked on speed and level stands beside them, so far toward the middle. */
export const SPEED = { x: 6, y: 46, width: 88, height: 380 } as const;
export const LEVEL = { x: 486, y: 46, width: 88, height: 380 } as const;
export const BESIDE = 17;
export const CLIMB = { x: 582, y: 46, width: 56, height: 380 } as const;
export const HEADING = { x: 112, y: 436, width: 356, height: 52 } as const;
export const APART = { x: 24, y: 562, width: 592 } as const;

/** Of pitch, speed, level and heading [px per deg, kt, ft, deg]. */
export const PER = { pitch: 10, knot: 3.8, foot: 0.31, degree: 7 } as const;

/** The roll bar moves by its own width for so much of bank, and no farther than for so much [deg]. */
const BAR = 28;
const BANK_PER_BAR = 15;
const MOST_ROLL = 45;
/** The pitch bar: half its width a degree, and no farther than for so many [deg]. */
const MOST_PULL = 6;

/** How far right of the middle the roll bar stands. `roll`: commanded less flown bank [deg] */
export function rollOffset(roll: number): number {
  return (BAR * clamp(roll, MOST_ROLL)) / BANK_PER_BAR;
}

/** How far above the middle the pitch bar stands. `pull`: commanded less flown path angle [deg] */
export function pullOffset(pull: number): number {
  return (BAR / 2) * clamp(pull, MOST_PULL);
}

function clamp(value: number, most: number): number {
  return Math.max(-most, Math.min(most, value));
}

/** Of climb: finer near level flight. From so many ft/min on, so many px from the middle. */
const CLIMBS = [
  [0, 0],
  [1000, 76],
  [2000, 124],
  [6000, 168],
] as const;
export const CLIMB_MARKS = [1000, 2000, 6000] as const;

/** How far above the middle a rate of climb stands. `climb` [m/s] */
export function climbOffset(climb: number): number {
  const feet = Math.min(6000, Math.abs(climb / FT) * 60);
  const k = CLIMBS.findIndex(([from]) => feet <= from);
  const [[low, at], [high, to]] = [CLIMBS[k - 1] ?? CLIMBS[0], CLIMBS[k] ?? CLIMBS[0]];
  const part = high === low ? 0 : (feet - low) / (high - low);
  return Math.sign(climb) * (at + part * (to - at));
}

/** The scale of separations doubles from mark to mark; its first is one of these [NM]. */
const FIRST = [0.25, 0.5, 1, 2.5, 5, 10] as const;
const DOUBLINGS = 5;

/** The marks of the scale round a least separation [NM]. `minSeparation` [m] */
export function apartMarks(minSeparation: number): readonly number[] {
  const first = FIRST.findLast((each) => each * NM <= 0.6 * minSeparation) ?? FIRST[0];
  return Array.from({ length: DOUBLINGS + 1 }, (_, k) => first * 2 ** k);
}

/** How far along the scale a separation stands [px], held to its ends. `separation` [m] */
export function apartOffset(separation: number, first: number): number {
  const doublings = Math.log2(Math.max(separation / NM, 1e-3) / first);
  return (APART.width * Math.max(0, Math.min(DOUBLINGS, doublings))) / DOUBLINGS;
}

export function knots({ tas }: Attitude): number {
  return tas / KT;
}

export function feet({ altitude }: Attitude): number {
  return altitude / FT;
}

/** How far a heading is right of another [deg]. */
export function beside(heading: number, from: number): number {
  return wrap180(heading - from);
}

/** A length in percent of the face, to a twentieth of a pixel. */
export function across(length: number): string {
  return percent(length / FACE.width);
}

export function down(length: number): string {
  return percent(length / FACE.height);
}

function percent(part: number): string {
  return `${Math.round(part * 100 * 150) / 150 + 0}%`;
}
