/** Buttons that are wired to nothing and remember what was pressed. */

import { vi } from "vitest";
import type { Actions } from "../src/session";

export function silentActions(): Actions {
  return {
    start: vi.fn(),
    end: vi.fn(),
    engage: vi.fn(),
    ownHeading: vi.fn(),
    setAutopilot: vi.fn(),
    setDirector: vi.fn(),
    selectBank: vi.fn(),
    selectSpeed: vi.fn(),
    setSpacing: vi.fn(),
    setLeaderData: vi.fn(),
    play: vi.fn(),
    pause: vi.fn(),
    setRate: vi.fn(),
    leaderHeading: vi.fn(),
    leaderSpeed: vi.fn(),
    setIntentKnown: vi.fn(),
    retry: vi.fn(),
    fly: vi.fn(),
    mapFromFlight: vi.fn(),
    reload: vi.fn(),
    seek: vi.fn(),
    step: vi.fn(),
    toMark: vi.fn(),
    live: vi.fn(),
    toggleLoop: vi.fn(),
    setLoop: vi.fn(),
    openRecord: vi.fn(),
    openFile: vi.fn(),
    compare: vi.fn(),
    compareWith: vi.fn(),
    endComparison: vi.fn(),
  };
}
