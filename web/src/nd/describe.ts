/** The picture in words, for those who do not see it. */

import { closestApproach, timeToJoin } from "../committed";
import { formatClock, formatHeading, formatMiles } from "../units";
import { type LayerProps, shownGuidance, shownNow } from "./picture";
import { age, separation } from "./states";
import { AGE } from "./style";
import { bearing } from "./view";

const MODE_WORDS = {
  heading: "holding heading",
  converge: "converging",
  capture: "capturing the leader's route",
  follow: "following the leader",
  escape: "turning away to keep the separation",
} as const;

export function describe({ flight, view }: LayerProps): string {
  const { mode, range } = view.layout.value;
  const head = `Navigation display, ${mode}, range ${range} nautical miles.`;
  const now = shownNow(flight);
  if (now === null) return `${head} Map not available.`;
  const leader = flight.started.value?.leader.ident ?? "the leader";
  const parts = [
    head,
    `Own ship ${MODE_WORDS[now.mode]}, heading ${formatHeading(now.pursuer.heading_deg)}.`,
    `Leader ${leader} bearing ${formatHeading(bearing(now.pursuer, now.leader))}, ${formatMiles(now.separation_m)} nautical miles.`,
  ];
  const [left, closest] = [timeToJoin(flight), closestApproach(flight)];
  if (shownGuidance(flight) !== null && left !== null && closest !== null) {
    const least = formatMiles(closest.least);
    parts.push(`Slot in ${formatClock(left)}, least separation ${least}.`);
  }
  if (flight.unavailable.value !== null) parts.push("No plan available.");
  if (flight.route.value?.intent_known === false) parts.push("Leader's intent unknown.");
  if (now.joined) parts.push("Joined.");
  const outlook = separation(flight).state;
  if (outlook === "lost") parts.push("Warning: separation lost.");
  if (outlook === "predicted") parts.push("Caution: loss of separation predicted.");
  if (AGE[age(flight)].flag !== "") parts.push("Caution: data old.");
  return parts.join(" ");
}
