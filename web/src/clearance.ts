/** What the page tells air traffic control for its crew: what it accepts is sent, what it engages is read back. */

import { request } from "./api";
import type { Session } from "./session";
import { inPageUnits } from "./units";
import type { Engagement } from "./wire";

type Say = (kind: "refused", text: string) => void;
type Reply = "WILCO" | "CANCEL";

/** A crew has brought guidance to `engagement`: what that says to the controller is sent; a refusal is said. */
export async function tellControl(
  session: Session,
  engagement: Engagement,
  say: Say,
): Promise<void> {
  const flight = session.status.value?.id;
  if (flight === undefined || engagement === "designated") return;
  if (engagement === "armed") {
    await post("clearances", { flight_id: flight }, say);
    return;
  }
  const { clearance } = session.flight.moment.value;
  const isOpen = clearance !== null && !["unable", "over"].includes(clearance.clearance);
  if (clearance === null || !isOpen) return;
  const isCleared = clearance.clearance === "validated";
  if (engagement === "engaged" && !isCleared) return;
  const reply: Reply = engagement === "engaged" ? "WILCO" : "CANCEL";
  const path = `clearances/${encodeURIComponent(clearance.clearance_id)}/replies`;
  await post(path, { reply }, say);
}

async function post(path: string, body: object, say: Say): Promise<void> {
  const answer = await request("POST", `api/v1/${path}`, body);
  if (answer.kind === "refused") say("refused", `ATC: ${inPageUnits(answer.sentence)}`);
}
