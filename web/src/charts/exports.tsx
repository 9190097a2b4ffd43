/** What is charted, as a drawing or a picture to be kept. */

import { type ReadonlySignal, useSignal } from "@preact/signals";
import { pngOf, saveFile } from "../save";
import type { Session } from "../session";
import { formatClock } from "../units";
import type { Window } from "./plot";
import type { Strip } from "./strips";
import { type About, chartSvg } from "./svg";

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
        onClick={() => saveFile(`${name}.svg`, new Blob([draw()], { type: "image/svg+xml" }))}
      >
        SVG
      </button>
      <button
        type="button"
        class="quiet"
        title="Save the charts as a picture (PNG)"
        onClick={() => {
          pngOf(draw()).then(
            (picture) => {
              refusal.value = "";
              saveFile(`${name}.png`, picture);
            },
            () => {
              refusal.value = "The browser could not draw it: take SVG.";
            },
          );
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
