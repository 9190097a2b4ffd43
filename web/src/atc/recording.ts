/** What was received as a file: a line that says what it is, then one document a line. */

import { member, parse } from "../json";
import type { AtcDocument } from "../wire";

const FORMAT = "relguide-atc";
const VERSION = 1;
/** The largest text that is read [bytes]. */
export const MOST_BYTES = 256 * 1024 * 1024;

export type Read =
  | { readonly kind: "read"; readonly documents: AtcDocument[] }
  | { readonly kind: "refused"; readonly sentence: string };

/** What each kind of document has at least. */
const PARTS: Record<AtcDocument["kind"], readonly string[]> = {
  clearance_changed: ["clearance"],
  traffic: ["sky", "aircraft"],
  probe_changed: ["id", "validation"],
  conformance: ["id", "aircraft", "deviations", "message"],
  expired: ["id", "message"],
};
/** … and what its members have. */
const MEMBERS: Readonly<Record<string, readonly string[]>> = {
  clearance: [
    "id",
    "sky",
    "aircraft",
    "traffic_id",
    "state",
    "route",
    "leader_route",
    "validation",
    "deviations",
    "history",
  ],
  sky: ["id", "title", "airspaces"],
  validation: ["verdict", "findings", "pairs", "alternatives"],
};

export function writeRecording(documents: readonly AtcDocument[]): string {
  const header = { format: FORMAT, version: VERSION };
  return [header, ...documents].map((each) => `${JSON.stringify(each)}\n`).join("");
}

/** Reads the text of a recording. What is wrong is said with its line. */
export function readRecording(text: string): Read {
  const [first = "", ...lines] = text.split("\n");
  const header = parse(first);
  if (member(header, "format") !== FORMAT)
    return refuse(1, `a recording begins with {"format":"${FORMAT}","version":${VERSION}}`);
  if (member(header, "version") !== VERSION)
    return refuse(1, `its version is not ${VERSION}, the one that this page reads`);
  const documents: AtcDocument[] = [];
  for (const [index, line] of lines.entries()) {
    if (line.trim() === "") continue;
    const found = parse(line);
    const wrong = problemOf(found);
    if (wrong !== null) return refuse(index + 2, wrong);
    documents.push(found as AtcDocument);
  }
  if (documents.length === 0)
    return { kind: "refused", sentence: "This recording is empty, so there is nothing to show." };
  return { kind: "read", documents };
}

function refuse(line: number, wrong: string): Read {
  const sentence = `This is no recording of the controller's page: line ${line}: ${wrong}.`;
  return { kind: "refused", sentence };
}

function problemOf(found: unknown): string | null {
  if (found === undefined) return "it is no JSON";
  const kind = member(found, "kind");
  if (typeof kind !== "string" || !(kind in PARTS))
    return `it is no document of this page: its kind is ${JSON.stringify(kind) ?? "missing"}`;
  if (!Number.isFinite(member(found, "t_s"))) return `${kind} has no t_s`;
  for (const name of PARTS[kind as AtcDocument["kind"]]) {
    const part = member(found, name);
    if (part === undefined) return `${kind} has no ${name}`;
    const missing = MEMBERS[name]?.find((each) => member(part, each) === undefined);
    if (missing !== undefined) return `the ${name} of ${kind} has no ${missing}`;
  }
  return null;
}
