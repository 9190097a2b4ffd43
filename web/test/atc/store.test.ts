import { describe, expect, it, test } from "vitest";
import { append, documentsOf, type Histories, MOST, newest, skyAt } from "../../src/atc/history";
import { readRecording, writeRecording } from "../../src/atc/recording";
import { emptySky, fold } from "../../src/atc/sky";
import { createAtcStore } from "../../src/atc/store";
import type { AtcDocument } from "../../src/wire";
import { changed, clearance, NOW, pair, seen, traffic, validation } from "./fixture";

const STREAM: AtcDocument[] = [
  seen([traffic("DLH1"), traffic("AFR1")]),
  changed(clearance("1")),
  seen([traffic("DLH1", { x_m: 230 })], NOW + 1),
  seen([traffic("AFR9")], 12, "abc"),
  changed(clearance("9", { sky: "abc" }), 13),
  {
    kind: "probe_changed",
    t_s: NOW + 2,
    id: "1",
    validation: validation({ verdict: "unable", pairs: [pair("BAW12", { certainty: "certain" })] }),
  },
  {
    kind: "conformance",
    t_s: NOW + 3,
    id: "1",
    aircraft: "DLH1",
    deviations: [
      {
        subject: "across",
        level: "alert",
        amount: 2200,
        unit: "m",
        since_s: NOW + 3,
        message: "DLH1 is 1.2 NM beside its path.",
      },
    ],
    message: "DLH1 is 1.2 NM beside its path.",
  },
  { kind: "expired", t_s: 70, id: "9", message: "Nobody answered." },
];

function told(documents: readonly AtcDocument[]): Histories {
  const histories: Histories = new Map();
  for (const document of documents) append(histories, document);
  return histories;
}

describe("the fold", () => {
  it("puts each document where it belongs", () => {
    const histories = told(STREAM);
    const [earth, flight] = ["", "abc"].map((id) => newest(histories.get(id) ?? raise(id)));
    expect(earth?.aircraft.map(({ x_m }) => x_m)).toEqual([230]);
    expect(earth?.clearances.get("1")?.validation[0]?.verdict).toBe("unable");
    expect(earth?.clearances.get("1")?.deviations[0]?.level).toBe("alert");
    expect(earth?.t).toBe(NOW + 3);
    expect(flight?.clearances.get("9")?.state).toBe("expired");
    expect(flight?.title).toBe("Flight abc");
  });

  it("names a sky without a title by its two aircraft", () => {
    const unnamed = emptySky("f3a9");
    expect(unnamed.title).toBe("A flight");
    const asks = fold(unnamed, changed(clearance("9", { sky: "f3a9" })));
    expect(asks.title).toBe("DLH9 behind AFR9");
    const other = fold(asks, changed(clearance("8", { sky: "f3a9" })));
    expect(other.title).toBe("DLH9 behind AFR9");
    expect(fold(other, seen([], NOW, "f3a9")).title).toBe("Flight f3a9"); // as the service calls it
    expect(emptySky("").title).toBe("All traffic");
  });

  it("keeps when and why a request expired, once", () => {
    const expired = {
      kind: "expired",
      t_s: NOW + 60,
      id: "1",
      message: "Nobody answered.",
    } as const;
    const sky = fold(fold(emptySky(""), changed(clearance("1"))), expired);
    expect(sky.clearances.get("1")?.history.at(-1)).toMatchObject({
      state: "expired",
      t_s: NOW + 60,
      message: "Nobody answered.",
    });
    expect(fold(sky, expired).clearances.get("1")?.history).toHaveLength(2);
  });

  it("leaves what it was given as it was", () => {
    const before = fold(emptySky(""), changed(clearance("1")));
    fold(before, changed(clearance("1", { state: "accepted" })));
    expect(before.clearances.get("1")?.state).toBe("validating");
  });

  it("passes over what is about a clearance that it does not know", () => {
    const histories = told([{ kind: "expired", t_s: NOW, id: "7", message: "" }]);
    expect(histories.size).toBe(0);
  });
});

describe("the history", () => {
  it("shows at any time what folding until then gives", () => {
    const history = told(STREAM).get("") ?? raise("");
    for (const t of [NOW, NOW + 0.5, NOW + 1, NOW + 2.5, NOW + 99]) {
      const folded = history.documents.filter((each) => each.t_s <= t).reduce(fold, emptySky(""));
      expect(skyAt(history, t)).toEqual(folded);
    }
  });

  it("forgets the oldest and still knows the clearances of then", () => {
    const many = Array.from({ length: MOST + 10 }, (_, k) => seen([], NOW + k));
    const history = told([changed(clearance("1")), ...many]).get("") ?? raise("");
    expect(history.documents.length).toBeLessThanOrEqual(MOST);
    expect(newest(history).clearances.has("1")).toBe(true);
    const again = told(documentsOf(history)).get("") ?? raise("");
    expect(newest(again)).toEqual(newest(history));
  });
});

test("an ended flight that has only ended requests has no tab", () => {
  const store = createAtcStore();
  const ended = clearance("9", { sky: "gone", state: "terminated" });
  store.receive([seen([]), changed(ended), changed(clearance("8", { sky: "new" }))]);
  expect(store.skies.value.map(({ id }) => id)).toEqual(["", "new"]);
  store.receive([seen([traffic("DLH9")], 5, "gone")]);
  expect(store.skies.value.map(({ id }) => id)).toEqual(["", "gone", "new"]);
});

describe("a recording", () => {
  it("comes back as it was saved", () => {
    const store = createAtcStore();
    store.receive(STREAM);
    const read = readRecording(writeRecording(store.documents()));
    if (read.kind === "refused") throw new Error(read.sentence);
    const again = createAtcStore();
    again.receive(read.documents);
    expect(again.skies.value).toEqual(store.skies.value);
  });

  it.each([
    ["", "line 1"],
    ['{"format":"relguide-atc","version":9}', "its version is not 1"],
    ['{"format":"relguide-atc","version":1}\nx', "line 2: it is no JSON"],
    ['{"format":"relguide-atc","version":1}\n{"kind":"tick"}', "its kind is"],
    [
      '{"format":"relguide-atc","version":1}\n{"kind":"traffic","t_s":1,"sky":{},"aircraft":[]}',
      "the sky of traffic has no id",
    ],
    ['{"format":"relguide-atc","version":1}\n', "is empty"],
  ])("that is wrong is refused with a sentence: %s", (text, sentence) => {
    const read = readRecording(text);
    expect(read.kind === "refused" && read.sentence).toContain(sentence);
  });
});

describe("the store", () => {
  it("shows the newest instant until another one is chosen", () => {
    const store = createAtcStore();
    store.receive(STREAM);
    expect(store.skies.value.map(({ id }) => id)).toEqual(["", "abc"]);
    expect(store.sky.value.t).toBe(NOW + 3);
    store.instant.value = NOW + 1;
    expect(store.sky.value.clearances.get("1")?.validation[0]?.verdict).toBe("acceptable");
    expect(store.span.value).toEqual([NOW, NOW + 3]);
    expect(store.marks.value.map(({ what }) => what)).toEqual(["DLH1 validating", "DLH1 deviates"]);
  });

  it("keeps the places of the last two minutes for dots", () => {
    const store = createAtcStore();
    store.receive(Array.from({ length: 200 }, (_, k) => seen([traffic("A", { x_m: k })], k)));
    const places = store.trail.value.map(({ aircraft }) => aircraft[0]?.x_m);
    expect(places).toEqual([189, 179, 169, 159, 149, 139, 129, 119, 109, 99, 89, 79]);
  });

  it("lets go of a sky that is not heard of while others are", () => {
    const store = createAtcStore();
    store.receive([seen([]), seen([], 5, "abc")], 0);
    store.receive([seen([], NOW + 59)], 59_000);
    expect(store.skies.value.map(({ id }) => id)).toEqual(["", "abc"]);
    store.receive([seen([], NOW + 60)], 60_000);
    expect(store.skies.value.map(({ id }) => id)).toEqual([""]);
  });

  it("opens the tab of the first sky that it hears of", () => {
    const store = createAtcStore();
    store.receive([seen([traffic("A")], 5, "abc")]);
    expect(store.tab.value).toBe("abc");
    store.clear();
    expect(store.skies.value).toEqual([]);
  });
});

function raise(id: string): never {
  throw new Error(`no sky ${id}`);
}
