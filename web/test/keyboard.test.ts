import { describe, expect, test } from "vitest";
import { isTaken, keyAction, stepAction } from "../src/keyboard";
import { edit, putSituation } from "../src/map/editing";
import { FIRST } from "../src/map/first";
import { createSession, stepRange } from "../src/session";
import { createFlightStore } from "../src/store/flight";
import { silentActions } from "./silence";

describe("the keys", () => {
  test("space plays and pauses", () => {
    const session = createSession(createFlightStore().flight);
    const actions = silentActions();
    keyAction(" ", session, actions)?.();
    expect(actions.pause).toHaveBeenCalledOnce();
    session.flight.clock.value = { rate: 1, paused: true, ended: false };
    keyAction(" ", session, actions)?.();
    expect(actions.play).toHaveBeenCalledOnce();
  });

  test("mode, range and scene", () => {
    const session = createSession(createFlightStore().flight);
    const press = (key: string) => keyAction(key, session, silentActions())?.();
    press("r");
    expect(session.ndMode.value).toBe("ROSE");
    press("A");
    expect(session.ndMode.value).toBe("ARC");
    press("+");
    expect(session.ndRange.value).toBe(80);
    press("-");
    expect(session.ndRange.value).toBe(40);
    press("m");
    expect(session.sceneMaximised.value).toBe(true);
    press("?");
    press("Escape");
    expect([session.sceneMaximised.value, session.helpOpen.value]).toEqual([false, false]);
    expect(keyAction("q", session, silentActions())).toBeNull();
  });

  test("a crew designates, confirms, engages and disconnects by keys", () => {
    const session = createSession(createFlightStore().flight);
    const actions = silentActions();
    for (const [key, engagement] of [
      ["d", "designated"],
      ["C", "armed"],
      ["e", "engaged"],
      ["X", "off"],
    ] as const) {
      keyAction(key, session, actions)?.();
      expect(actions.engage).toHaveBeenLastCalledWith(engagement);
    }
  });

  test("single letters can be switched off; the other keys stay", () => {
    const session = createSession(createFlightStore().flight);
    session.letterKeys.value = false;
    for (const key of ["d", "C", "r", "m", "x"])
      expect(keyAction(key, session, silentActions()), key).toBeNull();
    for (const key of [" ", "+", "?", "Escape"])
      expect(keyAction(key, session, silentActions()), key).not.toBeNull();
  });

  test("the range stops at its ends", () => {
    expect(stepRange(320, 1)).toBe(320);
    expect(stepRange(10, -1)).toBe(10);
  });

  test("what is typed into a field stays there, and space on a button presses it", () => {
    const from = (tag: string, key: string, init: KeyboardEventInit = {}) => {
      const event = new KeyboardEvent("keydown", { key, ...init });
      const target = document.body.appendChild(document.createElement(tag));
      target.dispatchEvent(event);
      return isTaken(event);
    };
    expect(from("input", "a")).toBe(true);
    expect(from("input", "Escape")).toBe(false);
    expect(from("button", " ")).toBe(true);
    expect(from("button", "a")).toBe(false);
    expect(from("div", "a", { ctrlKey: true })).toBe(true);
  });

  test("Ctrl-Z and its kin step through what was laid out, on the map and outside fields", () => {
    const session = createSession(createFlightStore().flight);
    const { map } = session;
    putSituation(map, FIRST);
    edit(map, (now) => ({ ...now, slot_distance_m: 20_000 }));
    const press = (key: string, init: KeyboardEventInit = {}, tag = "div") => {
      const event = new KeyboardEvent("keydown", { key, ctrlKey: true, ...init });
      document.body.appendChild(document.createElement(tag)).dispatchEvent(event);
      stepAction(event, session)?.();
      return map.situation.value.slot_distance_m;
    };
    expect(press("z")).toBe(20_000); // the map is not shown
    session.ndMode.value = "PLAN";
    expect(press("z", {}, "input")).toBe(20_000);
    expect(press("z")).toBe(FIRST.slot_distance_m);
    expect(press("Z", { shiftKey: true })).toBe(20_000);
    press("z");
    expect(press("y")).toBe(20_000);
    expect(press("z", { ctrlKey: false })).toBe(20_000);
  });
});
