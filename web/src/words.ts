/** What each element of the navigation display is: the same words under the pointer and in Help. */

export interface Element {
  /** Its class on the display. */
  readonly name: string;
  readonly title: string;
  readonly what: string;
  /** How Help draws its sign; "" for a readout, which needs none. */
  readonly key: string;
}

function element(name: string, title: string, what: string, key = ""): Element {
  return { name, title, what, key };
}

/** Those drawn on top come first: what is under the pointer is looked up in this order. */
export const ELEMENTS: readonly Element[] = [
  element(
    "fma",
    "Modes",
    "above in green what is engaged, below in cyan what comes next; a new one is boxed for 10 s; RG is relative guidance, SPD the speed that the crew selected, HDG its heading, AP1 the autopilot",
  ),
  element(
    "atc",
    "Order",
    "what became of your last one: SENT, ACCEPTED or REJECTED; then the controller's answer: STANDBY, VALIDATED (AUTO: by the automation), UNABLE with the reason",
  ),
  element("message", "Message", "the most urgent one; an arrow if there are more"),
  element(
    "spacing",
    "Spacing",
    "D to keep, d now, CLS how fast that closes, XTK how far beside the leader's route, CNV time to the join",
  ),
  element(
    "timing",
    "Early or late",
    "own ship beside the slot's index; in the box it is on time; the scale ends at 2 NM",
  ),
  element(
    "next",
    "Next",
    "the turn or the join that comes next: bearing, distance and how long until then",
  ),
  element(
    "flag",
    "Flag",
    "what is missing: data too old to be shown are taken away, and named here",
  ),
  element("air", "Air data", "ground speed, true airspeed, wind"),
  element(
    "leader",
    "Leader",
    "a hollow arrowhead; filled and ringed once it is designated",
    "key-leader-symbol",
  ),
  element(
    "other",
    "Other flight",
    "the one this is compared with: its path so far dashed, its aircraft broken; the path of this one thin",
    "key-other",
  ),
  element(
    "offscale",
    "Leader off the map",
    "half a symbol in its direction, with bearing and distance",
    "key-leader-symbol",
  ),
  element(
    "traffic",
    "Other aircraft",
    "a slim arrowhead along its track, filled when near; on an amber disc or a red square when an alert stands on it; its level over own ship in hundreds of feet, an arrow if it climbs or descends by 500 ft a minute; click it, or press T, for its numbers",
    "key-traffic",
  ),
  element(
    "traffic-edge",
    "Other aircraft off the map",
    "half a disc or square in its direction, while an alert stands on it",
    "key-traffic",
  ),
  element("ownship", "Own ship", "yellow, its nose up", "key-pursuer"),
  element("bug", "Selected heading", "hollow, cyan: the heading that the crew selected", "key-bug"),
  element(
    "commanded",
    "Commanded heading",
    "filled, magenta: what guidance asks for",
    "key-commanded",
  ),
  element("track", "Track", "a diamond where own ship really goes over the ground", "key-track"),
  element(
    "crosstrack",
    "Cross-track",
    "how far own ship is beside the leader's route, and on which side",
  ),
  element("trend", "Trend", "where own ship will be if it turns on as now; a tick each 30 s"),
  element("trackline", "Track line", "straight on, while no path is shown"),
  element("lubber", "Nose", "the mark over it: where the heading is read"),
  element(
    "closest",
    "Closest approach",
    "both aircraft when they are closest, and where the minimum will be round the leader then",
    "key-dotted",
  ),
  element(
    "nearest",
    "Nearest to another",
    "on the map: where the path is nearest to another aircraft or a cell, and when; amber where that leaves no path",
    "key-dotted",
  ),
  element("capture", "Join", "where own ship reaches the slot", "key-join"),
  element(
    "slot",
    "Slot",
    "D behind the leader: a gate as large as its tolerance, filled once own ship is in it",
    "key-slot",
  ),
  element(
    "turns",
    "Turns",
    "a tick where each begins and ends; chevrons when it is time to roll in",
    "key-plan",
  ),
  element(
    "minutes",
    "Minutes",
    "ticks with the same numbers: where both are at the same time",
    "key-plan",
  ),
  element(
    "proposed",
    "Proposed path",
    "dashed, yellow: it could be flown, and is not until you accept and engage it",
    "key-proposed",
  ),
  element("armed", "Accepted path", "dashed, cyan: it waits to be engaged", "key-armed"),
  element(
    "others",
    "Other paths",
    "thin, dotted: slower, or too close to the leader",
    "key-dotted",
  ),
  element(
    "rivals",
    "What other planners fly",
    "dotted, the chosen one dashed; amber: it may not be flown",
    "key-dotted",
  ),
  element(
    "fan",
    "Joins if it turns",
    "dotted, a hollow diamond at each end: where and when own ship joins if the leader, whose intent is not known, turns by 10°, 20° or 30° now",
    "key-dotted",
  ),
  element(
    "tube",
    "Width of the path",
    "dotted, on both sides of it: so far aside own ship may come, by what is uncertain of the leader and the wind",
    "key-dotted",
  ),
  element(
    "active",
    "Path",
    "solid, green: the path being flown, as the aircraft will really fly it",
    "key-plan",
  ),
  element(
    "old",
    "Path given up",
    "dotted: the last plan, which can no longer be flown",
    "key-dotted",
  ),
  element("final", "Final track", "where the leader will fly when it is joined", "key-plan"),
  element("fading", "Old path", "dotted: the plan before, for three seconds", "key-dotted"),
  element(
    "circle",
    "Minimum separation",
    "dashed circle; amber when it will be lost, red when it is",
    "key-min",
  ),
  element(
    "margin",
    "Margin",
    "thin, dashed, round the minimum: what guidance keeps beside it for what it is not certain of",
    "key-dotted",
  ),
  element("history", "Leader's past", "a dot each 10 s", "key-dotted"),
  element("intent", "Leader's route", "dash-dot: what it declared to fly", "key-leader"),
  element(
    "guess",
    "No intent",
    "dotted: the leader has declared nothing, straight ahead is assumed for three minutes",
    "key-dotted",
  ),
  element(
    "weather",
    "Weather cell",
    "hatched, to be kept out of; dashed: where it will be in five minutes",
    "key-weather",
  ),
  element(
    "area",
    "Area",
    "on the map: from where which word is the fastest, and lines of equal time, in minutes",
  ),
  element("rings", "Range", "rings at parts of the selected range"),
  element("tape", "Heading", "in tens of degrees, true"),
];

/** The element that a mark on the display belongs to, by the classes of it and what it stands in. */
export function elementOf(mark: globalThis.Element): Element | null {
  for (let each: globalThis.Element | null = mark; each !== null; each = each.parentElement) {
    const names = [...each.classList].map((name) => name.replace(/^nd-/, ""));
    const named = each.getAttribute("data-element");
    if (named !== null) names.push(named);
    const found = ELEMENTS.find(({ name }) => names.includes(name));
    if (found !== undefined) return found;
    if (each.tagName === "svg") return null;
  }
  return null;
}
