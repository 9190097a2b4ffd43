/** What each element of the navigation display is: the same words under the pointer and in Help. */

export interface Element {
  /** Its class on the display. */
  readonly name: string;
  readonly title: string;
  readonly what: string;
  /** How Help draws its sign; "" for a readout, which needs none. */
  readonly key: string;
}

/** Those drawn on top come first: what is under the pointer is looked up in this order. */
export const ELEMENTS: readonly Element[] = [
  {
    name: "fma",
    title: "Modes",
    what: "above in green what is engaged, below in cyan what comes next; a new one is boxed for 10 s",
    key: "",
  },
  {
    name: "atc",
    title: "Validation",
    what: "of the path you accepted: sent, valid, or rejected; the service stands for air traffic control",
    key: "",
  },
  {
    name: "message",
    title: "Message",
    what: "the most urgent one; an arrow if there are more",
    key: "",
  },
  {
    name: "spacing",
    title: "Spacing",
    what: "D to keep, d now, how fast it closes, offset from the leader's route, time to the join",
    key: "",
  },
  {
    name: "timing",
    title: "Early or late",
    what: "own ship beside the slot's index; in the box it is on time; the scale ends at 2 NM",
    key: "",
  },
  {
    name: "next",
    title: "Next",
    what: "the turn or the join that comes next: bearing, distance and how long until then",
    key: "",
  },
  { name: "air", title: "Air data", what: "ground speed, true airspeed, wind", key: "" },
  {
    name: "leader",
    title: "Leader",
    what: "a hollow arrowhead; filled and ringed once it is designated",
    key: "key-leader-symbol",
  },
  {
    name: "offscale",
    title: "Leader off the map",
    what: "half a symbol in its direction, with bearing and distance",
    key: "key-leader-symbol",
  },
  { name: "ownship", title: "Own ship", what: "yellow, its nose up", key: "key-pursuer" },
  {
    name: "bug",
    title: "Selected heading",
    what: "hollow, cyan: the heading that the crew selected",
    key: "key-bug",
  },
  {
    name: "commanded",
    title: "Commanded heading",
    what: "filled, magenta: what guidance asks for",
    key: "key-commanded",
  },
  {
    name: "track",
    title: "Track",
    what: "a diamond where own ship really goes over the ground",
    key: "key-track",
  },
  {
    name: "crosstrack",
    title: "Cross-track",
    what: "how far own ship is beside the leader's route, and on which side",
    key: "",
  },
  {
    name: "trend",
    title: "Trend",
    what: "where own ship will be if it turns on as now; a tick each 30 s",
    key: "",
  },
  { name: "trackline", title: "Track line", what: "straight on, while no path is flown", key: "" },
  { name: "lubber", title: "Nose", what: "the mark over it: where the heading is read", key: "" },
  {
    name: "closest",
    title: "Closest approach",
    what: "both aircraft when they are closest, and where the minimum will be round the leader then",
    key: "key-dotted",
  },
  { name: "capture", title: "Join", what: "where own ship reaches the slot", key: "key-join" },
  {
    name: "slot",
    title: "Slot",
    what: "D behind the leader: a gate as large as its tolerance, filled once own ship is in it",
    key: "key-slot",
  },
  {
    name: "turns",
    title: "Turns",
    what: "a tick where each begins and ends; chevrons when it is time to roll in",
    key: "key-plan",
  },
  {
    name: "minutes",
    title: "Minutes",
    what: "ticks with the same numbers: where both are at the same time",
    key: "key-plan",
  },
  {
    name: "proposed",
    title: "Proposed path",
    what: "dashed, yellow: it could be flown, and is not until you accept and engage it",
    key: "key-proposed",
  },
  {
    name: "armed",
    title: "Accepted path",
    what: "dashed, cyan: it waits to be engaged",
    key: "key-armed",
  },
  {
    name: "others",
    title: "Other paths",
    what: "thin, dotted: slower, or too close to the leader",
    key: "key-dotted",
  },
  {
    name: "active",
    title: "Path",
    what: "solid, green: the path being flown, as the aircraft will really fly it",
    key: "key-plan",
  },
  {
    name: "old",
    title: "Path given up",
    what: "dotted: the last plan, which can no longer be flown",
    key: "key-dotted",
  },
  {
    name: "final",
    title: "Final track",
    what: "where the leader will fly when it is joined",
    key: "key-plan",
  },
  {
    name: "fading",
    title: "Old path",
    what: "dotted: the plan before, for three seconds",
    key: "key-dotted",
  },
  {
    name: "circle",
    title: "Minimum separation",
    what: "dashed circle; amber when it will be lost, red when it is",
    key: "key-min",
  },
  { name: "history", title: "Leader's past", what: "a dot each 10 s", key: "key-dotted" },
  {
    name: "intent",
    title: "Leader's route",
    what: "dash-dot: what it declared to fly",
    key: "key-leader",
  },
  {
    name: "guess",
    title: "No intent",
    what: "dotted: the leader has declared nothing, straight ahead is assumed for three minutes",
    key: "key-dotted",
  },
  {
    name: "area",
    title: "Area",
    what: "on the map: from where which word is the fastest, and lines of equal time, in minutes",
    key: "",
  },
  { name: "rings", title: "Range", what: "rings at parts of the selected range", key: "" },
  { name: "tape", title: "Heading", what: "in tens of degrees, true", key: "" },
];

/** The element that a mark on the display belongs to, by the classes of it and what it stands in. */
export function elementOf(mark: globalThis.Element): Element | null {
  for (let each: globalThis.Element | null = mark; each !== null; each = each.parentElement) {
    const names = [...each.classList].map((name) => name.replace(/^nd-/, ""));
    const found = ELEMENTS.find(({ name }) => names.includes(name));
    if (found !== undefined) return found;
    if (each.tagName === "svg") return null;
  }
  return null;
}
