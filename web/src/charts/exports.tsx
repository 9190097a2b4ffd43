/** What is charted, as a drawing or a picture to be kept. */

import { type ReadonlySignal, useSignal } from "@preact/signals";
import type { Session } from "../session";
import { formatClock } from "../units";
import type { Window } from "./plot";
import type { Strip } from "./strips";
import { type About, chartSvg } from "./svg";

/** Pixels of a picture for each of the drawing's. */
const FINE = 2;

interface Props {
  readonly session: Session;
  readonly strips: ReadonlySignal<readonly Strip[]>;
  readonly window: ReadonlySignal<Window>;
}

export function Exports({ session, strips, window }: Props) {
  const refusal = useSignal("");
  const draw = () => chartSvg(strips.value, aboutOf(session, window.value));
  const name = `relguide-${nameOf(session)}-${formatClock(session.flight.read.value.t).replace(":", "")}`;
  return (
    <span class="chart-exports">
      <button
        type="button"
        class="quiet"
        title="Save the charts as a drawing (SVG)"
        onClick={() => save(new Blob([draw()], { type: "image/svg+xml" }), `${name}.svg`)}
      >
        SVG
      </button>
      <button
        type="button"
        class="quiet"
        title="Save the charts as a picture (PNG)"
        onClick={() => {
          void pictureOf(draw()).then((picture) => {
            refusal.value = picture === null ? "The browser could not draw it: take SVG." : "";
            if (picture !== null) save(picture, `${name}.png`);
          });
        }}
      >
        PNG
      </button>
      <span role="status">{refusal.value}</span>
    </span>
  );
}

function nameOf({ flight }: Session): string {
  const started = flight.read.value.started;
  return (started?.scenario || flight.id.value || "flight").replaceAll(/[^\w-]/g, "-");
}

/** Title and source: which flight, when it is drawn, by which version. */
function aboutOf({ flight, comparison }: Session, window: Window): About {
  const { started, t } = flight.read.value;
  const other = comparison.other.value;
  const title = started?.title ?? "A flight";
  const parts = [
    `flight ${flight.id.value ?? "–"}`,
    `planner ${started?.planner ?? "–"}`,
    `seed ${started?.seed ?? 0}`,
    `drawn ${new Date().toISOString().slice(0, 16).replace("T", " ")} UTC at ${formatClock(t)}`,
    `relguide ${__VERSION__}`,
  ];
  return {
    title: other === null ? title : `${title} — beside it: ${other.title}`,
    source: parts.join(" · "),
    ...window,
    cursor: t,
  };
}

/** A drawing as a picture; null where the browser draws none. */
async function pictureOf(drawing: string): Promise<Blob | null> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(drawing)}`;
  try {
    await image.decode();
  } catch {
    return null;
  }
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [FINE * image.width, FINE * image.height];
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

function save(content: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
