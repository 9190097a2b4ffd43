/** Of the others on the map: what they declare, where the plan is nearest to them, and who leaves no path. */

import { useComputed } from "@preact/signals";
import { pathPointAt, samplePath, windVector } from "../geometry";
import type { Label } from "../nd/labels";
import { Stroke } from "../nd/stroke";
import { ink, LINES } from "../nd/style";
import { onMap, type Place, placeAt, project, round, toMap, type View } from "../nd/view";
import { formatClock, formatMiles, NM } from "../units";
import type { Editor } from "./editor";
import { declaredRoute } from "./leader-route";
import { otherAt } from "./others";

/** Routes are drawn for so long [s], and after the join for so long as the plan is proved to keep clear. */
const LEAST_SHOWN = 600;
const AFTER_JOIN = 120;
/** What stays farther off than its minimum and this is not marked [m], nor more than so many. */
const NEAR = 5 * NM;
const MOST_MARKED = 3;

interface Mark {
  readonly ident: string;
  /** When [s], and how near [m]. */
  readonly at: number;
  readonly least: number;
  /** Own ship and the other then; null where own ship's path is not known. */
  readonly own: Place | null;
  readonly other: Place;
  /** What is to be kept to it [m]; 0 of a cell. */
  readonly limit: number;
  readonly isConflict: boolean;
}

function marksOf(map: Pick<Editor, "answered">): Mark[] {
  const answered = map.answered.value;
  if (answered === null) return [];
  const { situation, answer } = answered;
  const mark = (
    {
      ident,
      at_s,
      least_m,
      min_separation_m,
    }: {
      ident: string;
      at_s: number;
      least_m: number;
      min_separation_m: number;
    },
    own: Place | null,
  ): Mark[] => {
    const other = otherAt(situation, ident, at_s);
    if (other === null) return [];
    const isConflict = own === null;
    return [{ ident, at: at_s, least: least_m, own, other, limit: min_separation_m, isConflict }];
  };
  if (answer.status === "no_plan")
    return answer.conflict === undefined ? [] : mark(answer.conflict, null);
  const wind = windVector(situation.wind);
  return (answer.separation.others ?? [])
    .filter((each) => each.least_m - each.min_separation_m < NEAR)
    .slice(0, MOST_MARKED)
    .flatMap((each) => {
      const own = pathPointAt(answer.segments, each.at_s, wind);
      return own === null || each.at_s > answer.time_to_converge_s ? [] : mark(each, own);
    });
}

interface Props {
  readonly map: Editor;
  readonly view: View;
}

export function OthersLayer({ map, view }: Props) {
  const routes = useComputed(() => {
    const { situation, answered } = map;
    const { traffic, wind } = situation.value;
    const air = windVector(wind);
    const answer = answered.value?.answer;
    const join = answer?.status === "planned" ? answer.time_to_converge_s + AFTER_JOIN : 0;
    const layout = view.layout.value;
    return traffic
      .map((each) => {
        const path = samplePath(declaredRoute(each, air), air, 0, Math.max(LEAST_SHOWN, join));
        const points = path.map((point) => toMap(layout, point));
        return `M${points.map(({ x, y }) => `${round(x)} ${round(y)}`).join("L")}`;
      })
      .join("");
  });
  const marks = useComputed(() => marksOf(map));
  return (
    <>
      <g class="nd-intent">
        <Stroke d={routes} line={{ ...LINES.declared, width: 1.25 }} />
      </g>
      <g class="nd-nearest">
        {marks.value.map((mark) => (
          <NearestMark key={mark.ident} mark={mark} view={view} />
        ))}
      </g>
    </>
  );
}

function NearestMark({ mark, view }: { mark: Mark; view: View }) {
  const layout = view.layout.value;
  const { own, other, limit, isConflict } = mark;
  const to = toMap(layout, other);
  const from = own === null ? null : toMap(layout, own);
  const colour = isConflict ? "caution" : "label";
  return (
    <>
      {from !== null && limit > 0 && (
        <Stroke
          d={`M${round(from.x)} ${round(from.y)}L${round(to.x)} ${round(to.y)}`}
          line={{ ...LINES.closest, colour }}
        />
      )}
      {from !== null && (
        <path
          class="nd-hollow"
          d="M-5 -5H5V5H-5Z"
          transform={placeAt(from)}
          stroke={ink(colour)}
          stroke-width={2}
        />
      )}
      {limit > 0 && (
        <circle
          class="nd-stroke"
          r={round(limit * layout.scale)}
          transform={placeAt(to)}
          stroke={ink(colour)}
          stroke-width={isConflict ? 2.5 : LINES.ghostRing.width}
          stroke-dasharray={LINES.ghostRing.dash}
        />
      )}
      {isConflict && (
        <path
          class="nd-stroke"
          d="M-9 -9L9 9M-9 9L9 -9"
          transform={placeAt(to)}
          stroke={ink(colour)}
          stroke-width={3}
        />
      )}
    </>
  );
}

/** Labels have their places by these names. */
const NEAREST_IDS = Array.from({ length: MOST_MARKED }, (_, k) => `nearest ${k}`);

/** Who, how near and when. */
export function nearestLabels(map: Editor, view: View): Label[] {
  const pose = view.pose.value;
  const layout = view.layout.value;
  if (pose === null) return [];
  return marksOf(map).flatMap(({ ident, least, at, own, other, isConflict }, k) => {
    const point = project(layout, pose, own ?? other);
    if (!onMap(layout, point)) return [];
    const apart = least < 0 ? `${formatMiles(-least)} NM INSIDE` : `${formatMiles(least)} NM`;
    const near = `${apart} ${formatClock(at)}`;
    const colour = isConflict ? ("caution" as const) : ("label" as const);
    return [
      {
        id: NEAREST_IDS[k] ?? "",
        at: point,
        lines: [
          { text: ident, colour },
          { text: near, colour },
        ],
        side: 90,
        gap: 12,
        size: 16,
        optional: !isConflict,
      },
    ];
  });
}
