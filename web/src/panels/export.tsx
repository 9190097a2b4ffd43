/** What can be taken away: the display as a picture, and a flight on record as a file. */

import b612 from "@fontsource/b612/files/b612-latin-400-normal.woff2?url";
import { useSignal } from "@preact/signals";
import { EXPORT_FORMS, type ExportForm, readRecord } from "../api";
import type { PictureView } from "../picture/picture";
import { pngOf, saveFile, withFont } from "../save";
import type { Shown } from "../store/shown";

export interface ExportProps {
  readonly shown: Shown;
  readonly mode: PictureView["mode"];
  /** NM. */
  readonly range: PictureView["range"];
  /** The id of the flight, or the name of the file that it was read from. */
  readonly name: string;
  /** On record under this id; null for a flight that is not. */
  readonly recordId: string | null;
  /** When it began by the wall clock, as RFC 3339 has it; "" if that is not known. */
  readonly startedAt: string;
}

const FORM_NAMES: Record<ExportForm, string> = {
  jsonl: "Recording",
  csv: "CSV",
  parquet: "Parquet",
  geojson: "GeoJSON",
  czml: "CZML",
};
/** These lie on the earth. */
const PLACED: readonly ExportForm[] = ["geojson", "czml"];

export function Export(props: ExportProps) {
  const said = useSignal("");
  const isLight = useSignal(false);
  const isPlaced = useSignal(true);
  const lat = useSignal("");
  const lon = useSignal("");
  const { recordId } = props;

  async function picture(form: "svg" | "png"): Promise<void> {
    said.value = "";
    const svg = await drawingOf(props, isLight.value);
    const stem = props.name.replace(/\.jsonl(\.gz)?$/, "");
    const file = `${stem}-${Math.round(props.shown.picture.value.t)}s.${form}`;
    if (form === "svg") saveFile(file, new Blob([svg], { type: "image/svg+xml" }));
    else saveFile(file, await pngOf(await withFont(svg, "B612", b612)));
  }

  async function flight(id: string, form: ExportForm): Promise<void> {
    said.value = "";
    const isNeeded = PLACED.includes(form) && !isPlaced.value && lat.value !== "";
    const place = isNeeded ? { lat: Number(lat.value), lon: Number(lon.value) } : null;
    const answer = await readRecord(id, form, place);
    if (answer.kind === "done") saveFile(`flight-${id}.${form}`, answer.value);
    else {
      said.value = answer.sentence;
      if (PLACED.includes(form) && answer.status === 422) isPlaced.value = false;
    }
  }

  function attempt(task: Promise<void>): void {
    task.catch((error: unknown) => {
      said.value = error instanceof Error ? error.message : String(error);
    });
  }

  return (
    <div class="export">
      <fieldset class="row">
        <legend>The display</legend>
        {(["svg", "png"] as const).map((form) => (
          <button key={form} type="button" onClick={() => attempt(picture(form))}>
            {form.toUpperCase()}
          </button>
        ))}
        <label>
          <input
            type="checkbox"
            checked={isLight.value}
            onChange={(event) => {
              isLight.value = event.currentTarget.checked;
            }}
          />{" "}
          for paper
        </label>
      </fieldset>
      <fieldset class="row" disabled={recordId === null}>
        <legend>The flight{recordId === null && ", which is not on record"}</legend>
        {EXPORT_FORMS.map((form) => (
          <button
            key={form}
            type="button"
            onClick={() => recordId !== null && attempt(flight(recordId, form))}
          >
            {FORM_NAMES[form]}
          </button>
        ))}
      </fieldset>
      {!isPlaced.value && (
        <fieldset class="row">
          <legend>Where its x = y = 0 is</legend>
          <Degrees label="Latitude" most={90} value={lat} />
          <Degrees label="Longitude" most={180} value={lon} />
        </fieldset>
      )}
      <p role="status">{said}</p>
    </div>
  );
}

function Degrees(props: { label: string; most: number; value: { value: string } }) {
  return (
    <label>
      {props.label}{" "}
      <input
        type="number"
        step="any"
        min={-props.most}
        max={props.most}
        value={props.value.value}
        onInput={(event) => {
          props.value.value = event.currentTarget.value;
        }}
      />
      °
    </label>
  );
}

/** The picture as it is seen, with the flight and the command that draws it under it. */
export async function drawingOf(
  { shown, mode, range, name, recordId, startedAt }: ExportProps,
  isLight: boolean,
): Promise<string> {
  // what draws it is loaded when it is asked for
  const { pictureOfShown } = await import("../picture/picture");
  const t = Math.round(shown.picture.value.t * 10) / 10;
  const file = recordId === null ? name : `flight-${recordId}.jsonl`;
  const words = ["relguide picture", file, `--at ${t}`];
  if (mode !== "ARC") words.push(`--mode ${mode}`);
  if (range !== "auto") words.push(`--range ${range}`);
  if (isLight) words.push("--light");
  words.push("--out nd.svg");
  const begun = startedAt === "" ? "" : `, begun ${startedAt}`;
  const palette = isLight ? "light" : "dark";
  return pictureOfShown(
    shown,
    { mode, range, palette },
    `flight ${name}${begun}\n${words.join(" ")}`,
  );
}
