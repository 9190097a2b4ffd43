/** The situation of a flight at this instant: what the map begins with. */

import { cutPath, windVector } from "../geometry";
import type { Flight } from "../store/types";
import { cellAt } from "../store/weather";
import type { AircraftSample, CellCard, IntentPiece, PathSegment } from "../wire";
import { type MapCell, type Situation, settle } from "./situation";

/** Null while nothing is known of where the two are. */
export function situationOf(flight: Pick<Flight, "moment">): Situation | null {
  const { now, started, route } = flight.moment.value;
  if (now === null || started === null) return null;
  const { pursuer, leader } = now;
  const known = route?.intent_known === true ? route.segments : [];
  // between the two alone heights keep nothing apart
  const isAmid = now.others.length > 0;
  const level = ({ altitude_m }: AircraftSample) => (isAmid ? { altitude_m } : {});
  const rest = cutPath(known, windVector(started.wind), now.t_s);
  return settle({
    pursuer: {
      x_m: pursuer.x_m,
      y_m: pursuer.y_m,
      heading_deg: pursuer.heading_deg,
      tas_mps: pursuer.tas_mps,
      max_bank_deg: started.pursuer.max_bank_deg,
      ...level(pursuer),
    },
    leader: {
      x_m: leader.x_m,
      y_m: leader.y_m,
      heading_deg: leader.heading_deg,
      tas_mps: leader.tas_mps,
      intent: rest.slice(0, -1).flatMap(pieceOf),
      ...level(leader),
    },
    slot_distance_m: started.slot_distance_m,
    min_separation_m: started.min_separation_m,
    traffic: now.others.map(({ ident, x_m, y_m, heading_deg, tas_mps, altitude_m }) => ({
      ident,
      x_m,
      y_m,
      heading_deg,
      tas_mps,
      altitude_m,
      intent: [],
    })),
    cells: started.cells.flatMap((card) => discOf(card, now.t_s)),
    wind: started.wind,
  });
}

/** A cell at flight time `t` [s]; a polygon becomes the disc round it. */
function discOf(card: CellCard, t: number): MapCell[] {
  const { ident, east_mps, north_mps, growth_mps } = card;
  const { corners, radius } = cellAt(card, t);
  const [x_m, y_m] = (["x", "y"] as const).map(
    (axis) => corners.reduce((sum, each) => sum + each[axis], 0) / Math.max(1, corners.length),
  );
  if (x_m === undefined || y_m === undefined) return [];
  const far = Math.max(0, ...corners.map(({ x, y }) => Math.hypot(x - x_m, y - y_m)));
  return [{ ident, x_m, y_m, radius_m: radius + far, east_mps, north_mps, growth_mps }];
}

function pieceOf(segment: PathSegment): IntentPiece[] {
  switch (segment.kind) {
    case "straight":
      return [{ straight_s: Math.round(10 * segment.duration_s) / 10 }];
    case "turn":
      return [
        {
          turn_to_heading_deg: Math.round(10 * segment.end.heading_deg) / 10,
          direction: segment.direction,
          bank_deg: Math.round(10 * segment.bank_deg) / 10,
        },
      ];
    case "boundary":
      return [];
  }
}
