/** Fetches and reads the flights that are compared: loaded when the first one is. */

import { type Answer, flyScenario, readRecord } from "../api";
import { createHistory } from "../store/history";
import { readFile, titleOf } from "../timeline/opening";
import type { Compared } from "./compared";
import { splitReference } from "./references";

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
