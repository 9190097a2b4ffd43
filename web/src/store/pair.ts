/**
 * What the page shows of a flight: its first link, one pursuer behind one leader.
 *
 * A flight has any number of aircraft, known by their idents; here they become the two of the page.
 */

import type {
  AircraftCard,
  AircraftSample,
  CellCard,
  Document,
  FlightEnded,
  FlightStarted,
  GuidanceSample,
  LinkCard,
  LinkResult,
  Sample,
} from "../wire";

/** An aircraft beside the two, and the ident of the aircraft that it is to join; "" if there is none. */
interface OtherCard extends AircraftCard {
  readonly follows: string;
}

/** What is known of the two before the flight, and of what is about them. */
export interface PairCard
  extends Omit<FlightStarted, "kind" | "aircraft" | "links" | "cells">,
    Omit<LinkCard, "pursuer" | "leader"> {
  readonly pursuer: AircraftCard;
  readonly leader: AircraftCard;
  readonly others: readonly OtherCard[];
  readonly cells: readonly CellCard[];
}

/** The two at one instant, and all others. */
export interface PairSample extends Omit<GuidanceSample, "ident" | "leader"> {
  readonly t_s: number;
  readonly pursuer: AircraftSample;
  readonly leader: AircraftSample;
  readonly others: readonly AircraftSample[];
}

/** The two of the first link; null if the flight has none. */
export function pairCard(started: FlightStarted): PairCard | null {
  const { kind: _, aircraft, links, cells = [], ...flight } = started;
  const link = links[0];
  if (link === undefined) return null;
  const pursuer = withIdent(aircraft, link.pursuer);
  const leader = withIdent(aircraft, link.leader);
  if (pursuer === null || leader === null) return null;
  const others = beside(aircraft, link).map((each) => {
    const follows = links.find((other) => other.pursuer === each.ident)?.leader ?? "";
    return { ...each, follows };
  });
  return { ...flight, ...link, pursuer, leader, others, cells };
}

/** The two in a sample; null if it lacks one of them. */
export function pairSample(sample: Sample, pair: PairCard): PairSample | null {
  const pursuer = withIdent(sample.aircraft, pair.pursuer.ident);
  const leader = withIdent(sample.aircraft, pair.leader.ident);
  const guidance = withIdent(sample.guidance, pair.pursuer.ident);
  if (pursuer === null || leader === null || guidance === null) return null;
  const { ident: _, ...seen } = guidance;
  const others = beside(sample.aircraft, { pursuer: pursuer.ident, leader: leader.ident });
  return { ...seen, t_s: sample.t_s, pursuer, leader, others };
}

/** All but the two. */
function beside<T extends { readonly ident: string }>(
  all: readonly T[],
  { pursuer, leader }: Pick<LinkCard, "pursuer" | "leader">,
): readonly T[] {
  return all.filter(({ ident }) => ident !== pursuer && ident !== leader);
}

/** How it went for the two; null if that is not said. */
export function pairResult(ended: FlightEnded, pair: PairCard): LinkResult | null {
  return withIdent(ended.results, pair.pursuer.ident);
}

/** Whether a document is about the two. */
export function isAbout(document: Document, pair: PairCard): boolean {
  switch (document.kind) {
    case "flight_started":
    case "sample":
    case "flight_ended":
      return true;
    case "leader_route":
      return document.ident === pair.leader.ident && document.expected_by === pair.pursuer.ident;
    case "leader_changed":
      return document.ident === pair.leader.ident;
    case "plan_changed":
    case "plan_proposed":
    case "engagement_changed":
    case "control_changed":
    case "assignment_changed":
    case "clearance_news":
    case "plan_unavailable":
    case "plan_refused":
    case "mode_changed":
    case "promise_changed":
    case "alert":
    case "unable":
    case "separation_lost":
    case "forecast_changed":
    case "fan_changed":
      return document.ident === pair.pursuer.ident;
    case "command_given":
      return false; // what comes of it is said by other documents
  }
}

function withIdent<T extends { readonly ident: string }>(
  members: readonly T[],
  ident: string,
): T | null {
  return members.find((each) => each.ident === ident) ?? null;
}
