import { describe, expect, test } from "vitest";
import {
  alternativeSentence,
  alternativeTime,
  closureText,
  countTurns,
  crossTrackText,
  proofSentence,
  referenceText,
  spacingText,
} from "../../src/store/reading";
import { KT, NM } from "../../src/units";
import { planCard, rightTurn } from "../samples";

describe("numbers beside the picture", () => {
  test("turns are counted", () => {
    expect(countTurns(planCard({ segments: [rightTurn(90)] }))).toBe(1);
  });

  test("each proof has its words", () => {
    expect(proofSentence({ proof: "relaxation", lower_bound_s: 250 }, 250)).toMatch(/^Optimal/);
    expect(proofSentence({ proof: "certified", lower_bound_s: 249.95 }, 250)).toMatch(/^Optimal/);
    expect(proofSentence({ proof: "bound", lower_bound_s: 240 }, 250)).toContain("00:10");
    expect(proofSentence({ proof: "none", lower_bound_s: 240 }, 250)).toContain("not proved");
    expect(proofSentence({ proof: "none", lower_bound_s: 0 }, 250)).not.toContain("00:00");
  });

  test("alternatives say why they are not flown", () => {
    const plan = planCard();
    const way = { word: "LSR", turning_deg: 90, passes: "behind", side: "left" } as const;
    const slower = { ...way, time_to_converge_s: 256.2, why: "", rejected: "slower" } as const;
    expect(alternativeSentence(slower, plan)).toBe("+6.2 s");
    expect(alternativeSentence({ ...slower, time_to_converge_s: 314 }, plan)).toBe("+64 s");
    expect(alternativeSentence({ ...slower, time_to_converge_s: 1932 }, plan)).toBe("+28:02");
    const close = {
      ...way,
      time_to_converge_s: 240,
      rejected: "separation",
      least_separation_m: 4.99 * NM,
      at_s: 208,
      why: "comes within 4.99 NM at 208 s",
    } as const;
    expect(alternativeSentence(close, plan)).toBe("only 4.9 NM at 03:28");
    const equal = { ...slower, rejected: "as_fast", why: "as fast" } as const;
    expect(alternativeSentence(equal, plan)).toBe("as fast");
  });

  test("an alternative that comes too early says when the slot opens; one that never comes, so", () => {
    const early = {
      word: "RSR",
      time_to_converge_s: 210,
      release_time_s: 250,
      why: "reaches the slot 40 s before it opens",
      rejected: "not_open",
    } as const;
    expect(alternativeSentence(early, planCard())).toBe("slot opens 04:10");
    expect(alternativeTime(early)).toBe("03:30");
    const none = { word: "LRL", why: "no such path to the slot", rejected: "no_root" } as const;
    expect(alternativeSentence(none, planCard())).toBe("no such path");
    expect(alternativeTime(none)).toBe("–");
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
