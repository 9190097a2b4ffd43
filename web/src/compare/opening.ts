/** Flights to compare, by how the address names them: `scenario:fig_6a`, `record:3f2a9c0d71be`. */

import { type Answer, flyScenario, readRecord } from "../api";
import { createHistory } from "../store/history";
import { readFile, titleOf } from "../timeline/opening";
import type { Compared } from "./compared";

/** The two of the paper's conclusion. */
export const FIGURES = ["scenario:fig_6a", "scenario:fig_6b"] as const;

/** The flights that an address compares: two, or one that is seen beside the flight it shows. */
export function referencesIn(address: URLSearchParams): string[] {
  const text = address.get("compare") ?? "";
  return text.split(",").filter((each) => each !== "");
}

/** The recording that a reference names. */
export async function fetchReference(reference: string): Promise<Answer<Blob>> {
  const [kind, name] = splitReference(reference);
  if (kind === "scenario") return flyScenario(name);
  if (kind === "record") return readRecord(name);
  return {
    kind: "refused",
    status: 0,
    sentence: `“${reference}” names no flight: scenario:fig_6a or record:… would.`,
  };
}

export function splitReference(reference: string): [kind: string, name: string] {
  const at = reference.indexOf(":");
  return at < 0 ? ["", reference] : [reference.slice(0, at), reference.slice(at + 1)];
}

/** What is to be compared, or in a sentence why it cannot be. */
export async function readCompared(
  source: string | File,
): Promise<{ readonly kind: "read"; readonly compared: Compared } | Refused> {
  const isFile = typeof source !== "string";
  const answer: Answer<Blob> = isFile
    ? { kind: "done", value: source }
    : await fetchReference(source);
  if (answer.kind === "refused") return { kind: "refused", sentence: answer.sentence };
  const read = await readFile(answer.value);
  if (read.kind === "refused") return read;
  const history = createHistory();
  history.merge(read.documents);
  const reference = isFile ? null : source;
  return { kind: "read", compared: { reference, title: titleOf(read.documents), history } };
}

interface Refused {
  readonly kind: "refused";
  readonly sentence: string;
}
