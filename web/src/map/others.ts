/** Other aircraft and weather cells of a situation, as the map edits them. */

import { pathPointAt, windVector } from "../geometry";
import type { Place } from "../nd/view";
import type { CellCard, DiscCell, LocalTraffic } from "../wire";
import { declaredRoute } from "./leader-route";
import type { MapCell, MapTraffic, Situation } from "./situation";

/** How fast a new aircraft flies [m/s], and how large a new cell is [m]. */
const NEW = { tas: 230, radius: 15_000 } as const;
/** New ones stand so far from those that are there [m]. */
const APART = 8000;

/** One more aircraft, at a place or beside it where another is; it flies south. */
export function addTraffic(situation: Situation, near: Place): Situation {
  const { traffic, pursuer } = situation;
  const made: MapTraffic = {
    ident: freeIdent("TFC", situation),
    ...freePlace(situation, near),
    heading_deg: 180,
    tas_mps: NEW.tas,
    intent: [],
    ...(pursuer.altitude_m != null && { altitude_m: pursuer.altitude_m }),
  };
  return { ...situation, traffic: [...traffic, made] };
}

export function addCell(situation: Situation, near: Place): Situation {
  const made: MapCell = {
    ident: freeIdent("CB", situation),
    ...freePlace(situation, near),
    radius_m: NEW.radius,
    east_mps: 0,
    north_mps: 0,
    growth_mps: 0,
  };
  return { ...situation, cells: [...situation.cells, made] };
}

function freeIdent(begins: string, { traffic, cells }: Situation): string {
  const taken = new Set([...traffic, ...cells].map(({ ident }) => ident));
  for (let number = 1; ; number += 1)
    if (!taken.has(`${begins}${number}`)) return `${begins}${number}`;
}

function freePlace({ traffic, cells, pursuer, leader }: Situation, near: Place): Place {
  const there = [pursuer, leader, ...traffic, ...cells];
  const isFree = (x_m: number) =>
    there.every((each) => Math.hypot(each.x_m - x_m, each.y_m - near.y_m) >= APART);
  let x_m = near.x_m;
  while (!isFree(x_m)) x_m += APART;
  return { x_m, y_m: near.y_m };
}

/** As `POST /plans` takes them: what is empty is left out. */
export function bodiesOf({ traffic, cells }: Pick<Situation, "traffic" | "cells">): {
  traffic?: LocalTraffic[];
  cells?: DiscCell[];
} {
  return {
    ...(traffic.length > 0 && {
      traffic: traffic.map(({ intent, ...each }) => ({
        ...each,
        ...(intent.length > 0 && { intent: [...intent] }),
      })),
    }),
    ...(cells.length > 0 && {
      cells: cells.map(({ ident, x_m, y_m, radius_m, east_mps, north_mps, growth_mps }) => ({
        ident,
        disc: { x_m, y_m, radius_m },
        ...((east_mps !== 0 || north_mps !== 0) && { velocity_mps: [east_mps, north_mps] }),
        ...(growth_mps > 0 && { growth_mps }),
      })),
    }),
  };
}

/** As the documents of a flight have it. */
export function cellCard({ x_m, y_m, ...cell }: MapCell): CellCard {
  return { ...cell, x_m: [x_m], y_m: [y_m] };
}

/** Where another aircraft or the middle of a cell is at time `t` [s]; null for an unknown name. */
export function otherAt(situation: Situation, ident: string, t: number): Place | null {
  const wind = windVector(situation.wind);
  const aircraft = situation.traffic.find((each) => each.ident === ident);
  if (aircraft !== undefined) return pathPointAt(declaredRoute(aircraft, wind), t, wind);
  const cell = situation.cells.find((each) => each.ident === ident);
  if (cell === undefined) return null;
  return { x_m: cell.x_m + cell.east_mps * t, y_m: cell.y_m + cell.north_mps * t };
}
