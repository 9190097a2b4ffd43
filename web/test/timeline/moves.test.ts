import { expect, test, vi } from "vitest";
import { createSession } from "../../src/session";
import { createFlightStore } from "../../src/store/flight";
import { createMoves } from "../../src/timeline/moves";

test("a step on from the newest leaves the flight live, a step back does not", () => {
  const session = createSession(createFlightStore().flight);
  const seek = vi.fn();
  const { step } = createMoves(session, { seek, follow: vi.fn() }).moves;
  step(1);
  expect(seek).not.toHaveBeenCalled();
  step(-1);
  expect(seek).toHaveBeenCalledOnce();
});
