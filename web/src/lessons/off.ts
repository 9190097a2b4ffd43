/** How far off one is, in words: what a lesson shows, and says to those who listen. */

import type { PairSample } from "../store/pair";
import { DEG, wrap180 } from "../units";

/** Less than this is on it [deg]. */
const ON = 2;
const GRAVITY = 9.80665;

export function sayOff({ bars, reference, pursuer }: PairSample): string {
  const bar = bars?.[0];
  if (bar !== undefined) {
    if (Math.abs(bar.roll_deg) < ON) return "On the bar.";
    return `Bar ${amount(bar.roll_deg)}: roll ${side(bar.roll_deg)}.`;
  }
  if (reference.kind === "hold_heading") {
    const off = wrap180(reference.heading_deg - pursuer.heading_deg);
    if (Math.abs(off) < ON) return "On the heading.";
    return `The path's heading is ${amount(off)}: turn ${side(off)}.`;
  }
  const rate = reference.turn_rate_degps * DEG;
  const asked = Math.atan((pursuer.tas_mps * rate) / GRAVITY) / DEG;
  if (Math.abs(asked - pursuer.bank_deg) < ON) return "On the bank.";
  const wanted = Math.round(Math.abs(asked)) === 0 ? "wings level" : `${amount(asked)} bank`;
  return `The path asks for ${wanted}: roll ${side(asked - pursuer.bank_deg)}.`;
}

function side(value: number): string {
  return value > 0 ? "right" : "left";
}

function amount(value: number): string {
  return `${Math.round(Math.abs(value))}° ${side(value)}`;
}
