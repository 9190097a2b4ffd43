/** The display's elements, by the numbers of its specification, and in which states each is shown. */

import { GUIDANCES, type Guidance } from "../../src/store/states";

export interface ElementRow {
  readonly number: number;
  readonly name: string;
  /** Where it is drawn; null where the display has none of its kind: then `why` says what stands for it. */
  readonly selector: string | null;
  readonly why?: string;
  readonly states: ReadonlySet<Guidance>;
}

const ALL = GUIDANCES;
const JOINING = ALL.filter((state) => state !== "off");
const PLANNED: readonly Guidance[] = ["proposed", "armed", "converge"];
/** … and what holds until the join. */
const AHEAD: readonly Guidance[] = [...PLANNED, "capture"];
const CLOSE: readonly Guidance[] = ["capture", "follow"];
const HEARD = JOINING.filter((state) => state !== "data_lost");
const ENGAGED: readonly Guidance[] = ["converge", "capture", "follow", "escape"];

function row(
  number: number,
  name: string,
  selector: string,
  states: readonly Guidance[],
): ElementRow {
  return { number, name, selector, states: new Set(states) };
}

function none(number: number, name: string, why: string): ElementRow {
  return { number, name, selector: null, why, states: new Set() };
}

export const ELEMENT_ROWS: readonly ElementRow[] = [
  row(1, "heading tape", ".nd-tape text", ALL),
  row(2, "range rings", ".nd-rings path", ALL),
  row(3, "lubber line", ".nd-lubber path", ALL),
  row(4, "own ship", ".nd-ownship path", ALL),
  row(
    5,
    "selected heading bug",
    ".nd-bug path",
    ALL.filter((state) => !ENGAGED.includes(state) && state !== "unable"),
  ),
  row(6, "commanded heading", ".nd-commanded > path.nd-solid", [...ENGAGED, "unable"]),
  row(7, "track diamond", ".nd-track path", ALL),
  row(
    8,
    "track line",
    ".nd-trackline path",
    ALL.filter((state) => ![...ENGAGED, "proposed", "armed"].includes(state)),
  ),
  row(9, "GS and TAS", ".nd-air text", ALL),
  row(10, "wind", ".nd-air text:nth-of-type(5)", ALL),
  row(11, "next point", ".nd-next text", [...AHEAD, "follow"]),
  none(12, "own flight plan", "there is no route but the one to the slot"),
  row(13, "proposed path", ".nd-proposed path", ["proposed"]),
  row(14, "armed path", ".nd-armed path", ["armed"]),
  row(15, "active path", ".nd-active path", ENGAGED),
  row(16, "superseded path", ".nd-fading path", []),
  row(17, "turn points", ".nd-turns path", PLANNED),
  row(18, "roll-in cue", ".nd-rollin path", []),
  row(19, "trend vector", ".nd-trend path", ALL),
  row(20, "leader", ".nd-leader path", ALL),
  row(21, "leader's tag", ".nd-label text", ALL),
  row(22, "age of the leader's data", ".nd-leader circle[stroke-dasharray='10 7']", ["data_lost"]),
  row(23, "declared intent", ".nd-intent path", HEARD),
  row(24, "extrapolation", ".nd-guess path", []),
  row(25, "leader's past", ".nd-history path", JOINING),
  row(26, "final track", ".nd-final path", PLANNED),
  row(27, "slot", ".nd-slot path", HEARD),
  row(28, "join", ".nd-capture circle", AHEAD),
  row(29, "minimum separation", ".nd-circle circle", JOINING),
  none(30, "D ring", "the slot's gate says the same where it counts"),
  row(31, "closest approach", ".nd-closest circle", AHEAD),
  row(32, "minutes", ".nd-minutes path", PLANNED),
  none(33, "convergence area", "it is drawn on the map (PLAN), not in flight"),
  row(34, "spacing block", ".nd-spacing text", HEARD),
  row(35, "spacing scale", ".nd-timing path", CLOSE),
  row(36, "cross-track error, where there is one", ".nd-crosstrack", ["capture"]),
  row(37, "other traffic", ".nd-traffic path", ALL),
  row(38, "other traffic with an alert", ".nd-traffic circle.nd-solid", []),
  row(39, "leader off the map", ".nd-offscale path", []),
  none(40, "waypoints", "there is no route but the one to the slot"),
  none(41, "altitude-range arrow", "the flight keeps its level"),
  none(42, "speed-change point", "speed changes are not planned at a place"),
  row(43, "modes", ".nd-fma text", ALL),
  row(44, "message", ".nd-message text", [
    "designated",
    "proposed",
    "armed",
    "follow",
    "infeasible",
    "unable",
    "data_lost",
  ]),
  row(45, "the crew's order", ".nd-atc text", ["armed"]),
  row(46, "flags", ".nd-flag text", []),
  none(47, "simulated time and rate", "it stands outside the instrument, in the page's head"),
];
