/** The other aircraft: how each stands to own ship, and how urgent it is. */

import { type Vector, velocity } from "../geometry";
import { FT, NM } from "../units";
import type { AircraftSample, Alert } from "../wire";
import type { Moment } from "./types";

/** other: far away; proximate: near, or advised of; caution, warning: an alert stands. */
export type Urgency = "other" | "proximate" | "caution" | "warning";

/** Where two are closest if both fly straight on. */
interface Approach {
  /** How long until then [s]; 0 where they part already. */
  readonly in: number;
  /** How near [m]. */
  readonly least: number;
}

export interface Traffic {
  readonly aircraft: AircraftSample;
  readonly ident: string;
  /** Over own ship [m]. */
  readonly height: number;
  /** How fast it climbs [m/s]. */
  readonly climb: number;
  /** From own ship, level [m]. */
  readonly distance: number;
  readonly urgency: Urgency;
  readonly approach: Approach;
  /** Ident of the aircraft that it is to join; "" if there is none. */
  readonly follows: string;
}

/** What is nearer than this, level and in height, is proximate [m]: as TCAS has it. */
const NEAR = { level: 6 * NM, height: 1200 * FT } as const;
/** From this rate on an aircraft is said to climb or descend [m/s]: 500 ft a minute. */
export const TREND_FROM = (500 * FT) / 60;

/** All others of this moment, the least urgent first and of equals the farthest. */
export function trafficOf(flight: Moment): Traffic[] {
  const { now, started } = flight;
  if (now === null) return [];
  const { pursuer } = now;
  return now.others
    .map((aircraft) => {
      const { ident } = aircraft;
      const height = aircraft.altitude_m - pursuer.altitude_m;
      const distance = Math.hypot(aircraft.x_m - pursuer.x_m, aircraft.y_m - pursuer.y_m);
      return {
        aircraft,
        ident,
        height,
        climb: flight.climbs.get(ident) ?? 0,
        distance,
        urgency: urgencyOf(alertOn(flight, ident), distance, Math.abs(height)),
        approach: approachOf(pursuer, aircraft),
        follows: started?.others.find((each) => each.ident === ident)?.follows ?? "",
      };
    })
    .sort(
      (a, b) =>
        URGENCIES.indexOf(a.urgency) - URGENCIES.indexOf(b.urgency) || b.distance - a.distance,
    );
}
const URGENCIES: readonly Urgency[] = ["other", "proximate", "caution", "warning"];

function urgencyOf(alert: Alert | null, distance: number, height: number): Urgency {
  if (alert !== null && alert.level !== "advisory") return alert.level;
  const isNear = distance < NEAR.level && height < NEAR.height;
  return alert !== null || isNear ? "proximate" : "other";
}

/** The gravest alert that stands on another aircraft or a cell. */
export function alertOn({ alerts }: Pick<Moment, "alerts">, ident: string): Alert | null {
  const about = alerts.filter(({ other }) => other === ident);
  return (
    about.find(({ level }) => level === "warning") ??
    about.find(({ level }) => level === "caution") ??
    about[0] ??
    null
  );
}

/** Whether something is about another aircraft or a cell than the leader. */
export function isOnOther({ started }: Pick<Moment, "started">, ident: string): boolean {
  return (
    started !== null && [...started.others, ...started.cells].some((each) => each.ident === ident)
  );
}

export function approachOf(own: AircraftSample, other: AircraftSample): Approach {
  const apart = { x: other.x_m - own.x_m, y: other.y_m - own.y_m };
  const [mine, its] = [groundVelocity(own), groundVelocity(other)];
  const rate = { x: its.x - mine.x, y: its.y - mine.y };
  const square = rate.x ** 2 + rate.y ** 2;
  const until = square < 1e-6 ? 0 : Math.max(0, -(apart.x * rate.x + apart.y * rate.y) / square);
  return { in: until, least: Math.hypot(apart.x + until * rate.x, apart.y + until * rate.y) };
}

function groundVelocity({ ground_speed_mps, track_deg }: AircraftSample): Vector {
  return velocity(ground_speed_mps, track_deg);
}
