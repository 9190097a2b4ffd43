import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, expect, test, vi } from "vitest";
import { drawingOf, Export, type ExportProps } from "../src/panels/export";
import { shownAt } from "../src/picture/still";
import { modeChanged, planChanged, STARTED, sample } from "./samples";

const DOCUMENTS = [STARTED, modeChanged(0), planChanged(0), ...[0, 1, 2, 3].map((t) => sample(t))];
const PROPS: ExportProps = {
  shown: shownAt(DOCUMENTS, 2),
  mode: "ROSE",
  range: 40,
  name: "3f2a9c0d71be",
  recordId: "3f2a9c0d71be",
  startedAt: "2026-11-23T06:30:00.000Z",
};
const REFUSAL = "This flight has no latitudes: say by lat_deg and lon_deg where its x = y = 0 is.";

afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

/** Mounts it; what is saved, and what the service is asked. */
function mounted(props: Partial<ExportProps> = {}, answers: Response[] = []) {
  const saved: string[] = [];
  const asked: string[] = [];
  vi.stubGlobal("fetch", (url: string) => {
    asked.push(url);
    return Promise.resolve(answers.shift() ?? new Response("file"));
  });
  vi.spyOn(HTMLAnchorElement.prototype, "click").mockImplementation(function (this: unknown) {
    if (this instanceof HTMLAnchorElement) saved.push(this.download);
  });
  const place = document.createElement("div");
  act(() => render(<Export {...PROPS} {...props} />, place));
  const press = async (text: string) => {
    const button = [...place.querySelectorAll("button")].find((each) => each.textContent === text);
    await act(async () => {
      button?.click();
      await new Promise((resolve) => setTimeout(resolve, 5)); // what it awaits is answered at once
    });
  };
  return { place, saved, asked, press };
}

test("the display is saved under the flight's name and time", async () => {
  const { saved, press } = mounted();
  await press("SVG");
  await vi.waitFor(() => expect(saved).toEqual(["3f2a9c0d71be-2s.svg"]));
});

test("under the picture stand flight, start, and the command that draws it", async () => {
  const drawn = await drawingOf(PROPS, true);
  expect(drawn).toContain(">flight 3f2a9c0d71be, begun 2026-11-23T06:30:00.000Z<");
  const command =
    "relguide picture flight-3f2a9c0d71be.jsonl --at 2 --mode ROSE --range 40 --light";
  expect(drawn).toContain(`>${command} --out nd.svg<`);
  const ofFile = { ...PROPS, recordId: null, name: "a.jsonl.gz", startedAt: "" };
  expect(await drawingOf({ ...ofFile, mode: "ARC", range: "auto" }, false)).toContain(
    ">relguide picture a.jsonl.gz --at 2 --out nd.svg<",
  );
});

test("a flight on record is saved in each form", async () => {
  const { saved, asked, press } = mounted();
  for (const form of ["Recording", "CSV", "Parquet"]) await press(form);
  const path = "api/v1/records/flights/3f2a9c0d71be/export?format=";
  expect(asked).toEqual(["jsonl", "csv", "parquet"].map((form) => path + form));
  const names = ["jsonl", "csv", "parquet"].map((form) => `flight-3f2a9c0d71be.${form}`);
  expect(saved).toEqual(names);
});

test("a flight without latitudes asks where it lies", async () => {
  const refused = new Response(JSON.stringify({ detail: REFUSAL }), { status: 422 });
  const { place, saved, asked, press } = mounted({}, [refused]);
  await press("CZML");
  expect(place.textContent).toContain(REFUSAL);
  const inputs = place.querySelectorAll<HTMLInputElement>('input[type="number"]');
  act(() =>
    [...inputs].forEach((input, i) => {
      input.value = ["48.5", "-2"][i] ?? "";
      input.dispatchEvent(new Event("input", { bubbles: true }));
    }),
  );
  await press("CZML");
  expect(asked.at(-1)).toMatch(/format=czml&lat_deg=48.5&lon_deg=-2$/);
  expect(saved).toEqual(["flight-3f2a9c0d71be.czml"]);
  expect(place.querySelector('[role="status"]')?.textContent).toBe("");
});

test("a flight that is not on record has a picture and no file", () => {
  const { place } = mounted({ recordId: null });
  expect(place.textContent).toContain("not on record");
  expect(place.querySelectorAll("fieldset")[1]?.disabled).toBe(true);
});
