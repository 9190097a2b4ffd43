/** The REST service, as far as the cockpit uses it. A refusal is an answer with a sentence, not an exception. */

import type {
  AreaAnswer,
  AreaRequest,
  Command,
  FlightRequest,
  FlightStatus,
  OtherPathCard,
  PlanAnswer,
  PlannerComparison,
  ScenarioInfo,
  ScenarioList,
  SituationBody,
} from "./wire";

/** What the server said. `status` is 0 when it did not answer at all. */
export type Answer<T> =
  | { readonly kind: "done"; readonly value: T }
  | {
      readonly kind: "refused";
      readonly status: number;
      readonly sentence: string;
      /** The server asks to be asked again after so long [s]. */
      readonly retryAfter?: number;
    };

/** What a first start has compiled already: the answer of `/readyz`, ready or not. */
export interface Readiness {
  readonly status: "ready" | "preparing";
  readonly warm: Readonly<Record<string, boolean>>;
  readonly preparing: { readonly name: string; readonly share: number } | null;
}

/** Relative to the page, which a proxy may serve below a path of its own. */
const ROOT = "api/v1";
/** The server answers in milliseconds; after this long [ms] nobody is there. */
const PATIENCE = 8000;
/** The first flight of a new installation waits until the planner is compiled. */
const FIRST_FLIGHT_PATIENCE = 120_000;
/** A flight to its end takes a second, and may wait while others fly. */
const FLOWN_PATIENCE = 90_000;
/** A long flight on record takes some seconds to be read. */
const RECORD_PATIENCE = 60_000;

export async function listScenarios(): Promise<Answer<readonly ScenarioInfo[]>> {
  const answer = await request<ScenarioList>("GET", `${ROOT}/scenarios`);
  return answer.kind === "done" ? { kind: "done", value: answer.value.scenarios } : answer;
}

export function createFlight(wanted: FlightRequest): Promise<Answer<FlightStatus>> {
  return request("POST", `${ROOT}/flights`, wanted, FIRST_FLIGHT_PATIENCE);
}

export function readFlight(id: string): Promise<Answer<FlightStatus>> {
  return request("GET", `${ROOT}/flights/${encodeURIComponent(id)}`);
}

export function commandFlight(id: string, command: Command): Promise<Answer<FlightStatus>> {
  return request("POST", `${ROOT}/flights/${encodeURIComponent(id)}/commands`, command);
}

/** A plan with its flight and the other paths to the slot, those that are drawn included; within `most` [ms]. */
export function planSituation(
  situation: SituationBody,
  most: number,
): Promise<Answer<PlanAnswer & { readonly others?: readonly OtherPathCard[] }>> {
  const query = `include=alternatives,paths,flown&max_ms=${most}`;
  return request("POST", `${ROOT}/plans?${query}`, situation);
}

/** A plan with Pontryagin's conditions along it, H and the costates. */
export function checkSituation(situation: SituationBody): Promise<Answer<PlanAnswer>> {
  return request("POST", `${ROOT}/plans?include=optimality&max_ms=2000`, situation);
}

/** A scenario flown to its end at once, as a recording. */
export function flyScenario(name: string): Promise<Answer<Blob>> {
  return download(`${ROOT}/scenarios/${encodeURIComponent(name)}/flight`, FLOWN_PATIENCE);
}

/** What each planner would fly. */
export function comparePlanners(situation: SituationBody): Promise<Answer<PlannerComparison>> {
  return request("POST", `${ROOT}/plans/compare`, situation);
}

/** Regions of words and lines of equal time. */
export function drawArea(wanted: AreaRequest): Promise<Answer<AreaAnswer>> {
  return request("POST", `${ROOT}/areas`, wanted);
}

export function endFlight(id: string): Promise<Answer<null>> {
  return request("DELETE", `${ROOT}/flights/${encodeURIComponent(id)}`);
}

/** A flight on record, in short: what the list shows of it. */
export interface RecordedFlight {
  readonly id: string;
  readonly scenario: string;
  readonly title: string;
  readonly outcome: string;
  /** RFC 3339, UTC. */
  readonly started_at: string;
  readonly figures: {
    readonly join_time_s: number | null;
    readonly least_separation_m: number | null;
  };
}

/** The newest flights on record. */
export function listRecords(
  most: number,
): Promise<Answer<{ readonly flights: readonly RecordedFlight[] }>> {
  return request("GET", `${ROOT}/records/flights?limit=${most}`);
}

/** One flight on record, in short. */
export function readRecorded(id: string): Promise<Answer<RecordedFlight>> {
  return request("GET", `${ROOT}/records/flights/${encodeURIComponent(id)}`);
}

/** The forms in which a flight on record can be had. */
export const EXPORT_FORMS = ["jsonl", "csv", "parquet", "geojson", "czml"] as const;
export type ExportForm = (typeof EXPORT_FORMS)[number];

/** A flight on record as a file. `place`: where on the earth its x = y = 0 is, for a flight that has none. */
export function readRecord(
  id: string,
  form: ExportForm = "jsonl",
  place: { readonly lat: number; readonly lon: number } | null = null,
): Promise<Answer<Blob>> {
  const where = place === null ? "" : `&lat_deg=${place.lat}&lon_deg=${place.lon}`;
  const path = `${ROOT}/records/flights/${encodeURIComponent(id)}/export?format=${form}${where}`;
  return download(path, RECORD_PATIENCE);
}

/** Null if the server does not say. */
export async function readReadiness(): Promise<Readiness | null> {
  try {
    const response = await fetch("readyz", { signal: AbortSignal.timeout(PATIENCE) });
    return (await response.json()) as Readiness;
  } catch {
    return null;
  }
}

/** A file of the service; `patience` in ms. */
async function download(path: string, patience: number): Promise<Answer<Blob>> {
  try {
    const response = await fetch(path, { signal: AbortSignal.timeout(patience) });
    if (response.ok) return { kind: "done", value: await response.blob() };
    const sentence = sentenceOf(parse(await response.text()), response.status);
    return { kind: "refused", status: response.status, sentence };
  } catch {
    return { kind: "refused", status: 0, sentence: "The server does not answer." };
  }
}

/** Asks the service for JSON; `path` is relative to the page, `patience` in ms. */
export async function request<T>(
  method: string,
  path: string,
  body?: unknown,
  patience = PATIENCE,
): Promise<Answer<T>> {
  const init: RequestInit = { method, signal: AbortSignal.timeout(patience) };
  if (body !== undefined) {
    init.body = JSON.stringify(body);
    init.headers = { "content-type": "application/json" };
  }
  let response: Response;
  let text: string;
  try {
    response = await fetch(path, init);
    text = await response.text();
  } catch {
    return { kind: "refused", status: 0, sentence: "The server does not answer." };
  }
  const content = parse(text);
  if (response.ok && content !== undefined) return { kind: "done", value: content as T };
  const refused = {
    kind: "refused",
    status: response.status,
    sentence: sentenceOf(content, response.status),
  } as const;
  const retryAfter = Number(response.headers.get("retry-after") ?? "");
  return response.status === 503 && retryAfter > 0 ? { ...refused, retryAfter } : refused;
}

function parse(text: string): unknown {
  if (text === "") return null;
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

/** The sentence of a problem document (RFC 9457): its detail, else its title. */
export function sentenceOf(problem: unknown, status: number): string {
  if (typeof problem === "object" && problem !== null) {
    for (const member of ["detail", "title"]) {
      const value: unknown = Reflect.get(problem, member);
      if (typeof value === "string" && value !== "") return value;
    }
  }
  return `The server refused, without saying why (status ${status}).`;
}
