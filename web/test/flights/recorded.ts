/** Recordings of real flights for tests: `relguide fly fig_6a --record`, of routes and forecasts the first only. */

import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { createHistory, type History } from "../../src/store/history";
import type { Document } from "../../src/wire";

export function documentsOf(name: "fig_6a" | "fig_6b"): Document[] {
  const lines = gunzipSync(readFileSync(`test/flights/${name}.jsonl.gz`)).toString();
  const documents = lines.trim().split("\n").slice(1);
  return documents.map((line) => JSON.parse(line) as Document);
}

export function historyOf(name: "fig_6a" | "fig_6b", until = Number.POSITIVE_INFINITY): History {
  const history = createHistory();
  history.merge(documentsOf(name).filter(({ t_s }) => t_s <= until));
  return history;
}
