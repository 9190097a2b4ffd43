import { useComputed } from "@preact/signals";
import { TREND_FROM } from "../store/traffic";
import { FT } from "../units";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { ink } from "./style";
import { onMap, placeAt, project, toMap } from "./view";

const CHEVRON = "M0 -14L11 12L0 5L-11 12Z";
/** A broken ring has four gaps. */
export const BROKEN = "10 7";
export const RINGS = [18, 23] as const;
/** What may be clicked on: 24 px of the page, however small the glass. */
const TOUCH = 32;

/** The leader: a chevron along its heading in a double ring, since it is the one we join. */
export function Leader({ shown, view }: LayerProps) {
  const place = useComputed(() => {
    const leader = leaderOnMap({ shown, view });
    return leader === null ? null : placeAt(toMap(view.layout.value, leader), leader.heading_deg);
  });
  const isShown = useComputed(() => place.value !== null);
  const at = useComputed(() => place.value ?? "");
  const style = usePart(shown, (picture) => picture.leaderAge);
  const designated = usePart(shown, (picture) => picture.designated);
  const isLost = usePart(shown, ({ separation }) => separation.state === "lost");
  const fill = useComputed(() => ink(isLost.value ? "alert" : style.value.colour));
  if (!isShown.value) return null;
  const broken = style.value.ring === "broken";
  return (
    <g class="nd-leader" transform={at}>
      {(designated.value ? RINGS : []).map((radius) => (
        <circle
          key={radius}
          class="nd-stroke"
          r={radius}
          stroke={ink(style.value.colour === "leader" ? "leader-ring" : style.value.colour)}
          stroke-width={2}
          stroke-dasharray={broken ? BROKEN : ""}
        />
      ))}
      {designated.value ? (
        <path class="nd-solid" d={CHEVRON} fill={fill} />
      ) : (
        <path class="nd-hollow" d={CHEVRON} stroke={fill} stroke-width={2.5} />
      )}
      <circle class="nd-touch" r={TOUCH} />
    </g>
  );
}

/** The leader when its symbol can be seen whole, else null. */
export function leaderOnMap({ shown, view }: LayerProps) {
  const [{ leader }, pose] = [shown.picture.value, view.pose.value];
  if (leader === null || pose === null) return null;
  const point = project(view.layout.value, pose, leader);
  return onMap(view.layout.value, point) ? leader : null;
}

/** Who the leader is, how much higher or lower [hundreds of feet], its ground speed [kt], its data's age. */
export function leaderTag({ shown, view }: LayerProps): Label | null {
  const [{ now, leaderAge, ageSeconds, ident, designated, leaderClimb }, pose] = [
    shown.picture.value,
    view.pose.value,
  ];
  const leader = leaderOnMap({ shown, view });
  if (leader === null || now === null || pose === null) return null;
  const at = project(view.layout.value, pose, leader);
  const height = relativeAltitude(leader.altitude_m - now.pursuer.altitude_m);
  const level = `${height}${trendSign(leaderClimb)}`;
  const { colour } = leaderAge;
  const lines = [{ text: ident, colour }];
  if (designated) lines.push({ text: `${level} ${shown.numbers.value.leaderSpeed}`, colour });
  else if (level !== "+00") lines.push({ text: level, colour });
  if (leaderAge.showsAge) lines.push({ text: `${ageSeconds} S`, colour });
  return {
    id: "leader",
    at,
    lines,
    side: at.x > view.layout.value.centre.x ? 60 : -60,
    gap: 27,
    size: 20,
    optional: false,
  };
}

/** "↑" or "↓" from 500 ft a minute on; "" for level. `climb` [m/s] */
export function trendSign(climb: number): "" | "↑" | "↓" {
  return Math.abs(climb) < TREND_FROM - 0.01 ? "" : climb > 0 ? "↑" : "↓";
}

/** Height over the own ship in hundreds of feet with its sign, e.g. "+00", "−12". `height` [m] */
export function relativeAltitude(height: number): string {
  const hundreds = Math.round(height / FT / 100) + 0;
  return `${hundreds < 0 ? "−" : "+"}${String(Math.abs(hundreds)).padStart(2, "0")}`;
}
