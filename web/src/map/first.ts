import type { Situation } from "./situation";

/** The paper's Fig. 6b: what a map shows that was given nothing else. */
export const FIRST: Situation = {
  pursuer: { x_m: -40_000, y_m: 40_000, heading_deg: 90, tas_mps: 240, max_bank_deg: 25 },
  leader: {
    x_m: 0,
    y_m: 0,
    heading_deg: 90,
    tas_mps: 200,
    intent: [{ straight_s: 820 }, { turn_to_heading_deg: 135, direction: "right", bank_deg: 25 }],
  },
  traffic: [],
  cells: [],
  slot_distance_m: 10_000,
  min_separation_m: 9260,
  wind: { from_deg: 0, speed_mps: 0 },
};
