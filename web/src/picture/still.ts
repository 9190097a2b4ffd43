/** A flight at one instant: what was known of it then, from its documents alone. */

import { signal } from "@preact/signals";
import { emptyFlight } from "../store/flight";
import { createHistory, type History, momentAt } from "../store/history";
import { createShown, type Shown } from "../store/shown";
import type { Document } from "../wire";

/**
 * What is shown of a flight at flight time `t` [s].
 *
 * @param documents - in order of time.
 * @throws if `t` is outside the flight, in a sentence.
 */
export function shownAt(documents: readonly Document[], t: number): Shown {
  const [first, last] = [documents[0], documents.at(-1)];
  if (first === undefined || last === undefined)
    throw new Error("There is nothing to draw: the flight has no documents.");
  if (!(t >= first.t_s && t <= last.t_s))
    throw new Error(
      `t = ${t} s is outside the flight, which goes from ${first.t_s} s to ${last.t_s} s.`,
    );
  const history = createHistory();
  history.merge(documents);
  return shownOf(history, t);
}

/** The same of a flight whose documents are known already. */
function shownOf(history: History, t: number): Shown {
  const moment = signal(momentAt(history, t));
  return createShown({ ...emptyFlight(), moment, read: moment });
}

/**
 * The documents of a text: a recording, a line each, or a JSON array.
 *
 * @throws if a line is no JSON, with its number.
 */
export function documentsOf(text: string): Document[] {
  if (text.trimStart().startsWith("[")) return JSON.parse(text);
  return text.split("\n").flatMap((line, index) => {
    if (line.trim() === "") return [];
    try {
      const document = JSON.parse(line);
      return "kind" in document ? [document] : []; // the head of a recording has none
    } catch {
      throw new Error(`Line ${index + 1} of the flight is no document: ${line.slice(0, 40)}`);
    }
  });
}
