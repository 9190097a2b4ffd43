import { describe, expect, test } from "vitest";
import {
  alternativeSentence,
  closureText,
  countTurns,
  crossTrackText,
  nextTurn,
  proofSentence,
  referenceText,
  spacingText,
} from "../src/reading";
import { KT, NM } from "../src/units";
import { planCard, planChanged, point, rightTurn, straight } from "./samples";

describe("numbers beside the picture", () => {
  test("the next turn: to come, being flown, none left", () => {
    const lead = straight(point(0, 0, 0, 0), 60, 100);
    const turn = rightTurn(90);
    const later = (p: typeof turn.start) => ({ ...p, t_s: p.t_s + 60 });
    const moved = { ...turn, start: later(turn.start), end: later(turn.end) };
    const changed = planChanged(100, { segments: [lead, moved] });
    expect(nextTurn(changed, 130)).toEqual({
      direction: "right",
      angle: expect.closeTo(90, 9),
      in: 30,
    });
    const half = nextTurn(changed, 160 + turn.duration_s / 2);
    expect(half?.in).toBe(0);
    expect(half?.angle).toBeCloseTo(45, 9);
    expect(nextTurn(changed, 200)).toBeNull();
    expect(countTurns(changed.plan)).toBe(1);
  });

  test("each proof has its words", () => {
    expect(proofSentence({ proof: "relaxation", lower_bound_s: 250 }, 250)).toMatch(/^Optimal/);
    expect(proofSentence({ proof: "bound", lower_bound_s: 240 }, 250)).toContain("00:10");
    expect(proofSentence({ proof: "none", lower_bound_s: 240 }, 250)).toContain("not proved");
    expect(proofSentence({ proof: "none", lower_bound_s: 0 }, 250)).not.toContain("00:00");
  });

  test("alternatives say why they are not flown", () => {
    const plan = planCard();
    const slower = { word: "LSR", time_to_converge_s: 256.2, rejected: "slower" } as const;
    expect(alternativeSentence(slower, plan)).toBe("+6.2 s");
    expect(alternativeSentence({ ...slower, time_to_converge_s: 314 }, plan)).toBe("+64 s");
    expect(alternativeSentence({ ...slower, time_to_converge_s: 1932 }, plan)).toBe("+28:02");
    const close = {
      word: "LSL",
      time_to_converge_s: 240,
      rejected: "separation",
      least_separation_m: 4.99 * NM,
      at_s: 208,
    } as const;
    expect(alternativeSentence(close, plan)).toBe("loses separation: 4.9 NM at 03:28");
  });

  test("signs become words", () => {
    expect(closureText(35 * KT)).toBe("closing 35 kt");
    expect(closureText(-35 * KT)).toBe("opening 35 kt");
    expect(closureText(0)).toBe("steady");
    expect(spacingText(NM)).toBe("1.00 NM behind");
    expect(spacingText(-NM)).toBe("1.00 NM ahead");
    expect(crossTrackText(-NM / 2)).toBe("0.50 NM L");
    expect(referenceText({ kind: "hold_heading", heading_deg: 0 })).toBe("HDG 360");
    expect(referenceText({ kind: "turn_rate", turn_rate_degps: -1.5 })).toBe("TURN 1.5°/s L");
  });
});
