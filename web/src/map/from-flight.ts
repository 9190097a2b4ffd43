/** The situation of a flight at this instant: what the map begins with. */

import { cutPath, windVector } from "../geometry";
import type { Flight } from "../store/types";
import type { IntentPiece, PathSegment } from "../wire";
import { type Situation, settle } from "./situation";

/** Null while nothing is known of where the two are. */
export function situationOf(flight: Pick<Flight, "moment">): Situation | null {
  const { now, started, route } = flight.moment.value;
  if (now === null || started === null) return null;
  const { pursuer, leader } = now;
  const known = route?.intent_known === true ? route.segments : [];
  const rest = cutPath(known, windVector(started.wind), now.t_s);
  return settle({
    pursuer: {
      x_m: pursuer.x_m,
      y_m: pursuer.y_m,
      heading_deg: pursuer.heading_deg,
      tas_mps: pursuer.tas_mps,
      max_bank_deg: started.pursuer.max_bank_deg,
    },
    leader: {
      x_m: leader.x_m,
      y_m: leader.y_m,
      heading_deg: leader.heading_deg,
      tas_mps: leader.tas_mps,
      intent: rest.slice(0, -1).flatMap(pieceOf),
    },
    slot_distance_m: started.slot_distance_m,
    min_separation_m: started.min_separation_m,
    wind: started.wind,
  });
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
