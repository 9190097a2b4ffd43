/** A situation as a program. */

import type { IntentPiece, LocalLeader } from "../wire";
import type { Situation } from "./situation";

export function pythonOf(situation: Situation): string {
  const { pursuer, leader, traffic, cells, wind } = situation;
  const place = (
    name: string,
    { x_m, y_m, heading_deg, tas_mps, altitude_m }: Omit<LocalLeader, "intent">,
  ) =>
    `${name}x=${x_m}, y=${y_m}, heading=radians(${heading_deg}), tas=${tas_mps}` +
    (altitude_m == null ? "" : `, altitude=${altitude_m}`);
  const pieceText = (piece: IntentPiece) => {
    if ("straight_s" in piece) return `FlyStraight(duration=${piece.straight_s})`;
    if ("level_change" in piece) {
      const { to_altitude_m, rate_mps, hold } = piece.level_change;
      const speed = hold === undefined ? "" : `, hold="${hold}"`;
      return `ChangeLevel(to_altitude=${to_altitude_m}, rate=${rate_mps}${speed})`;
    }
    const { turn_to_heading_deg, direction, bank_deg } = piece;
    return (
      `TurnTo(heading=radians(${turn_to_heading_deg}), turn=${direction.toUpperCase()}, ` +
      `bank=radians(${bank_deg}))`
    );
  };
  const pieces = leader.intent.map(pieceText);
  const others = [
    ...traffic.map(({ ident, min_separation_m, ...each }) => {
      const declared = each.intent.map((piece) => `${pieceText(piece)}, `).join("");
      return (
        `${place(`Traffic(ident="${ident}", `, each)}, ` +
        `min_separation=${min_separation_m ?? situation.min_separation_m}` +
        `${declared === "" ? "" : `, intent=(${declared.trimEnd()})`})`
      );
    }),
    ...cells.map(
      ({ ident, x_m, y_m, radius_m, east_mps, north_mps, growth_mps }) =>
        `Cell(ident="${ident}", shape=Disc(x=${x_m}, y=${y_m}, radius=${radius_m}), ` +
        `east=${east_mps}, north=${north_mps}, growth=${growth_mps})`,
    ),
  ];
  const flown = [leader, ...traffic].flatMap(({ intent }) => intent);
  const used = (names: Record<string, boolean>) => Object.keys(names).filter((each) => names[each]);
  const turns = flown.flatMap((piece) => ("direction" in piece ? [piece.direction] : []));
  const names = used({
    LEFT: turns.includes("left"),
    RIGHT: turns.includes("right"),
    Cell: cells.length > 0,
    ChangeLevel: flown.some((piece) => "level_change" in piece),
    Disc: cells.length > 0,
    FlyStraight: flown.some((piece) => "straight_s" in piece),
    Leader: true,
    Pursuer: true,
    Situation: true,
    Traffic: traffic.length > 0,
    TurnTo: turns.length > 0,
    plan: true,
    wind_from: wind.speed_mps > 0,
  });
  const intent =
    pieces.length > 0 ? `,\n    intent=(\n        ${pieces.join(",\n        ")},\n    )` : "";
  const air =
    wind.speed_mps > 0 ? `\n    wind=wind_from(radians(${wind.from_deg}), ${wind.speed_mps}),` : "";
  const amid =
    others.length > 0
      ? `\n    others=(\n        ${others.map((each) => `${each},`).join("\n        ")}\n    ),`
      : "";
  return `from math import radians

from relguide import ${names.join(", ")}

own = ${place("Pursuer(\n    ", pursuer)}, max_bank=radians(${pursuer.max_bank_deg})
)
leader = ${place("Leader(\n    ", leader)}${intent},
)
situation = Situation(
    pursuer=own,
    leader=leader,
    slot_distance=${situation.slot_distance_m},
    min_separation=${situation.min_separation_m},${air}${amid}
)
print(plan(situation))
`;
}
