/** A recording as text: a line that says what it is, then one document a line. What is wrong is said with its line. */

import { member, parse } from "../json";
import type { Document } from "../wire";

/** The header of a file that the page can show, as `relguide fly --record` writes it. */
const FORMAT = "relguide-flight";
const VERSION = 3;

/** The largest text that is read [bytes]: some fifteen hours of flight. */
export const MOST_BYTES = 64 * 1024 * 1024;

export type Read =
  | { readonly kind: "read"; readonly documents: Document[] }
  | { readonly kind: "refused"; readonly sentence: string };

/** No flight is longer [s]. */
const LONGEST = 1e6;

/** What each kind of document has at least. */
const PARTS: Record<Document["kind"], readonly string[]> = {
  flight_started: ["aircraft", "links", "wind", "title", "planner"],
  leader_route: ["ident", "expected_by", "segments"],
  leader_changed: ["ident", "message"],
  plan_changed: ["ident", "message", "plan", "leader_at_closest", "pursuer_at_closest"],
  plan_proposed: ["ident", "plan", "promised_s", "leader_at_closest", "pursuer_at_closest"],
  engagement_changed: ["ident", "engagement", "previous", "message"],
  command_given: ["command"],
  control_changed: ["ident", "autopilot", "director", "message"],
  assignment_changed: ["ident", "slot_distance_m", "min_separation_m", "max_bank_deg", "message"],
  clearance_news: ["ident", "clearance", "level", "message"],
  plan_unavailable: ["ident", "answer"],
  plan_refused: ["ident", "message"],
  mode_changed: ["ident", "mode", "message"],
  promise_changed: ["ident", "message"],
  alert: ["ident", "other", "level", "subject", "message"],
  unable: ["ident", "reason", "message"],
  separation_lost: ["ident", "cause"],
  forecast_changed: ["ident", "times_s", "x_m", "y_m", "heading_deg", "pursuer_at_closest"],
  fan_changed: ["ident", "joins", "most_saved_s", "mean_saved_s"],
  sample: ["aircraft", "guidance"],
  flight_ended: ["reason", "message", "results"],
};
const OF_AIRCRAFT = [
  "ident",
  "x_m",
  "y_m",
  "heading_deg",
  "track_deg",
  "tas_mps",
  "ground_speed_mps",
  "altitude_m",
  "turn_rate_degps",
  "bank_deg",
];
const OF_GUIDANCE = [
  "ident",
  "leader",
  "mode",
  "reference",
  "slot",
  "separation_m",
  "time_to_go_s",
];
const OF_PLAN = ["word", "segments", "separation", "optimality", "time_to_converge_s"];

/** Reads the text of a recording. */
export function parseRecording(text: string): Read {
  const lines = text.split("\n");
  const problem = headerProblem(lines[0] ?? "");
  if (problem !== null) return refuse(1, problem);
  const documents: Document[] = [];
  for (const [index, line] of lines.entries()) {
    if (index === 0 || line.trim() === "") continue;
    const found = parse(line);
    const wrong = found === undefined ? "it is no JSON" : documentProblem(found);
    if (wrong !== null) return refuse(index + 1, wrong);
    documents.push(found as Document);
  }
  if (documents[0]?.kind !== "flight_started")
    return refuse(2, "a flight begins with flight_started");
  if (!documents.some(({ kind }) => kind === "sample"))
    return {
      kind: "refused",
      sentence: "This recording holds no sample, so there is nothing to show.",
    };
  return { kind: "read", documents };
}

function refuse(line: number, wrong: string): Read {
  return {
    kind: "refused",
    sentence: `This is no recording that can be shown: line ${line}: ${wrong}.`,
  };
}

function headerProblem(line: string): string | null {
  const header = parse(line);
  const [format, version] = [member(header, "format"), member(header, "version")];
  if (format !== FORMAT)
    return `a recording begins with {"format":"${FORMAT}","version":${VERSION}}, as relguide fly --record writes it`;
  if (version !== VERSION)
    return `its form is ${String(version)}, and this page reads ${VERSION}: record the flight again`;
  return null;
}

/** What is wrong with a document; null if nothing is. */
function documentProblem(found: unknown): string | null {
  const kind = member(found, "kind");
  if (typeof kind !== "string") return 'it has no "kind"';
  if (!(kind in PARTS)) return `no document is called "${kind.slice(0, 40)}"`;
  const t = member(found, "t_s");
  if (typeof t !== "number") return `${kind} has no t_s`;
  if (Math.abs(t) > LONGEST) return `its t_s is ${t}, and no flight is longer than ${LONGEST} s`;
  return (
    missing(found, PARTS[kind as Document["kind"]], kind) ??
    partProblem(found, "aircraft", kind === "sample" ? OF_AIRCRAFT : ["ident"]) ??
    partProblem(found, "guidance", OF_GUIDANCE) ??
    partProblem(found, "links", ["pursuer", "leader", "min_separation_m", "slot_distance_m"]) ??
    partProblem(found, "segments", ["kind", "start", "end"]) ??
    (kind === "plan_changed" || kind === "plan_proposed"
      ? (missing(member(found, "plan"), OF_PLAN, "its plan") ??
        partProblem(member(found, "plan"), "segments", ["kind", "start", "end"]))
      : null) ??
    contentProblem(found, kind)
  );
}

function missing(whole: unknown, names: readonly string[], what: string): string | null {
  const name = names.find((each) => member(whole, each) === undefined);
  return name === undefined ? null : `${what} has no ${name}`;
}

/** What is wrong with the members of a list, where the document has that list. */
function partProblem(whole: unknown, name: string, names: readonly string[]): string | null {
  const list = member(whole, name);
  if (list === undefined) return null;
  if (!Array.isArray(list)) return `${name} is no list`;
  for (const each of list) {
    const wrong = missing(each, names, `one of ${name}`);
    if (wrong !== null) return wrong;
  }
  return null;
}

/** A name with a unit is a number, or a list of numbers. */
const HAS_UNIT = /_(m|s|mps|deg|degps|ms|s_per_deg|s_per_m)$/;

/** What is text wherever it stands, and what has members of its own. */
const IS_TEXT = new Set(["ident", "kind", "message", "mode", "title", "word"]);
const HAS_MEMBERS = new Set([
  "answer",
  "end",
  "leader_at_closest",
  "optimality",
  "plan",
  "pursuer_at_closest",
  "reference",
  "separation",
  "slot",
  "start",
  "wind",
]);

function contentProblem(value: unknown, path: string): string | null {
  if (Array.isArray(value)) {
    for (const each of value) {
      const wrong = contentProblem(each, path);
      if (wrong !== null) return wrong;
    }
    return null;
  }
  if (typeof value !== "object" || value === null) return null;
  for (const [name, content] of Object.entries(value)) {
    if (IS_TEXT.has(name) && typeof content !== "string") return `${path}.${name} is no text`;
    if (HAS_MEMBERS.has(name) && (typeof content !== "object" || content === null))
      return `${path}.${name} has no members`;
    const isMeasured = HAS_UNIT.test(name) && content !== null;
    if (isMeasured && ![content].flat(3).every((each) => each === null || Number.isFinite(each)))
      return `${path}.${name} is no number`;
    if (!isMeasured) {
      const wrong = contentProblem(content, `${path}.${name}`);
      if (wrong !== null) return wrong;
    }
  }
  return null;
}
