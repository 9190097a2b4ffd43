import { useComputed } from "@preact/signals";
import type { Label } from "./labels";
import type { LayerProps } from "./layer";
import { Stroke } from "./stroke";
import { LINES } from "./style";
import { onMap, type Place, placeAt, project, round, toMap, type View } from "./view";

/** Own ship of the other flight, and its leader: the same symbols, hollow and broken. */
const OWN = "M0 -15V17M-17 0H17M-7 14H7";
const LEADER = "M0 -14L11 12L0 5L-11 12Z";
const BROKEN = "5 3";

/** The flight that this one is compared with: its path so far dashed, that of this one thin and solid. */
export function OtherFlight({ shown, view }: LayerProps) {
  const isShown = useComputed(() => shown.ghost.value !== null);
  const flown = useComputed(() => pathOf(view, shown.ghost.value?.flown));
  const own = useComputed(() => pathOf(view, shown.ghost.value?.own));
  const pursuer = useComputed(() => symbolAt(view, shown.ghost.value?.pursuer));
  const leader = useComputed(() => symbolAt(view, shown.ghost.value?.leader));
  if (!isShown.value) return null;
  return (
    <g class="nd-other" data-element="other">
      <Stroke d={own} line={LINES.beside} />
      <Stroke d={flown} line={LINES.other} />
      <g transform={pursuer}>
        <Stroke d={OWN} line={{ ...LINES.other, width: 3, dash: BROKEN }} />
      </g>
      {leader.value !== "" && (
        <g transform={leader}>
          <Stroke d={LEADER} line={{ ...LINES.other, dash: BROKEN }} />
        </g>
      )}
    </g>
  );
}

function pathOf(view: View, places: readonly Place[] = []): string {
  const layout = view.layout.value;
  const points = places.map((place) => toMap(layout, place));
  return points.length < 2
    ? ""
    : `M${points.map(({ x, y }) => `${round(x)} ${round(y)}`).join("L")}`;
}

function symbolAt(view: View, aircraft: (Place & { heading_deg: number }) | null = null): string {
  if (aircraft === null) return "";
  return placeAt(toMap(view.layout.value, aircraft), aircraft.heading_deg);
}

/** What the other flight is called, beside its aircraft. */
export function ghostLabels({ shown, view }: LayerProps): Label[] {
  const [ghost, pose] = [shown.ghost.value, view.pose.value];
  if (ghost === null || pose === null) return [];
  const { value: layout } = view.layout;
  const over = ghost.isOutside ? [{ text: "NOT FLYING", colour: "superseded" as const }] : [];
  return [
    { id: "other", place: ghost.pursuer, lines: [{ text: ghost.name }] },
    { id: "other leader", place: ghost.leader, lines: [{ text: `${ghost.name} LDR` }] },
  ].flatMap(({ id, place, lines }) => {
    const at = place === null ? null : project(layout, pose, place);
    if (at === null || !onMap(layout, at)) return [];
    const named = lines.map((line) => ({ ...line, colour: "superseded" as const }));
    return [
      {
        id,
        at,
        lines: id === "other" ? [...named, ...over] : named,
        side: at.x > layout.centre.x ? 60 : -60,
        gap: 22,
        size: 18,
        optional: false,
      },
    ];
  });
}
