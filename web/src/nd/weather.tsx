import { useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import { type Cell, edgeOf } from "../store/weather";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink, LINES } from "./style";
import { type Layout, onMap, type Point, project, round, toMap } from "./view";

/** Between two lines of the hatch [px]; farther where that would be more lines than this. */
const HATCH = 13;
const MOST_LINES = 60;

export const WEATHER_COLOUR: Record<Cell["urgency"], Colour> = {
  none: "label",
  caution: "caution",
  warning: "alert",
};

/** Weather cells: hatched, since nothing else is; dashed where each will be in five minutes. */
export function Weather({ shown, view }: LayerProps) {
  const cells = usePart(shown, (picture) => picture.cells);
  const layout = useComputed(() => view.layout.value);
  if (cells.value.length === 0) return null;
  return (
    <>
      {cells.value.map((cell) => {
        const colour = WEATHER_COLOUR[cell.urgency];
        const edge = glassEdge(layout.value, cell);
        return (
          <g key={cell.ident} class="nd-weather">
            <path
              class="nd-stroke"
              d={hatchOf(edge)}
              stroke={ink(cell.urgency === "none" ? LINES.hatch.colour : colour)}
              stroke-width={LINES.hatch.width}
            />
            <Stroke
              d={closed(edge)}
              line={{ ...LINES.cell, colour, width: cell.urgency === "none" ? 2 : 3 }}
            />
            {cell.later !== null && (
              <Stroke d={closed(glassEdge(layout.value, cell.later))} line={LINES.cellLater} />
            )}
          </g>
        );
      })}
    </>
  );
}

/** The edge of a cell on the map [px], clockwise as it is seen from below. */
function glassEdge(layout: Layout, cell: Pick<Cell, "corners" | "radius">): Point[] {
  return edgeOf(cell, 10).map(({ x, y }) => toMap(layout, { x_m: x, y_m: y }));
}

function closed(edge: readonly Point[]): string {
  return `M${edge.map(({ x, y }) => `${round(x)} ${round(y)}`).join("L")}Z`;
}

/** Parallel lines at 45° through a convex shape. */
export function hatchOf(edge: readonly Point[]): string {
  const across = edge.map(({ x, y }) => (x + y) / Math.SQRT2);
  const [from, to] = [Math.min(...across), Math.max(...across)];
  const step = Math.max(HATCH, (to - from) / MOST_LINES);
  let drawn = "";
  for (let c = from + step / 2; c < to; c += step) {
    const ends = edge.flatMap((a, k) => {
      const b = edge[(k + 1) % edge.length] ?? a;
      const [p, q] = [(a.x + a.y) / Math.SQRT2 - c, (b.x + b.y) / Math.SQRT2 - c];
      if (p < 0 === q < 0) return [];
      const part = p / (p - q);
      return [{ x: a.x + part * (b.x - a.x), y: a.y + part * (b.y - a.y) }];
    });
    const [a, b] = ends;
    if (a !== undefined && b !== undefined)
      drawn += `M${round(a.x)} ${round(a.y)}L${round(b.x)} ${round(b.y)}`;
  }
  return drawn;
}

/** What each cell is called, in its middle. */
export function weatherLabels({ shown, view }: LayerProps): Label[] {
  const pose = view.pose.value;
  if (pose === null) return [];
  const layout = view.layout.value;
  return shown.picture.value.cells.flatMap((cell) => {
    const { corners, ident, urgency } = cell;
    const sum = corners.reduce((a, b) => ({ x: a.x + b.x, y: a.y + b.y }), { x: 0, y: 0 });
    const middle = { x_m: sum.x / corners.length, y_m: sum.y / corners.length };
    const at = project(layout, pose, middle);
    if (!onMap(layout, at)) return [];
    return [
      {
        id: weatherId(ident),
        at,
        lines: [{ text: ident, colour: WEATHER_COLOUR[urgency] }],
        side: 180,
        gap: 14, // on the map its middle is taken hold of
        size: 18,
        optional: urgency === "none",
      },
    ];
  });
}

export function weatherId(ident: string): string {
  return `weather ${ident}`;
}
