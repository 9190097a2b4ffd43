import { useComputed } from "@preact/signals";
import { FT } from "../units";
import type { Label } from "./labels";
import { type LayerProps, usePart } from "./layer";
import { ink } from "./style";
import { onMap, placeAt, project, toMap } from "./view";

const CHEVRON = "M0 -14L11 12L0 5L-11 12Z";
/** A broken ring has four gaps. */
export const BROKEN = "10 7";
export const RINGS = [18, 23] as const;

/** The leader: a chevron along its heading in a double ring, since it is the one we join. */
export function Leader({ shown, view }: LayerProps) {
  const place = useComputed(() => {
    const leader = leaderOnMap({ shown, view });
    return leader === null ? null : placeAt(toMap(view.layout.value, leader), leader.heading_deg);
  });
  const isShown = useComputed(() => place.value !== null);
  const at = useComputed(() => place.value ?? "");
  const look = usePart(shown, (picture) => picture.age);
  const isLost = usePart(shown, ({ separation }) => separation.state === "lost");
  const fill = useComputed(() => ink(isLost.value ? "alert" : look.value.colour));
  if (!isShown.value) return null;
  const broken = look.value.ring === "broken";
  return (
    <g class="nd-leader" transform={at}>
      {RINGS.map((radius) => (
        <circle
          key={radius}
          class="nd-stroke"
          r={radius}
          stroke={ink(look.value.colour === "leader" ? "leader-ring" : look.value.colour)}
          stroke-width={2}
          stroke-dasharray={broken ? BROKEN : ""}
        />
      ))}
      <path class="nd-solid" d={CHEVRON} fill={fill} />
    </g>
  );
}

/** The leader when its symbol can be seen whole, else null. */
export function leaderOnMap({ shown, view }: LayerProps) {
  const [{ now }, pose] = [shown.picture.value, view.pose.value];
  if (now === null || pose === null) return null;
  const point = project(view.layout.value, pose, now.leader);
  return onMap(view.layout.value, point) ? now.leader : null;
}

/** Who the leader is, how much higher or lower [hundreds of feet], its ground speed [kt], its data's age. */
export function leaderTag({ shown, view }: LayerProps): Label | null {
  const [{ now, age, ageSeconds, ident }, pose] = [shown.picture.value, view.pose.value];
  const leader = leaderOnMap({ shown, view });
  if (leader === null || now === null || pose === null) return null;
  const at = project(view.layout.value, pose, leader);
  const height = relativeAltitude(leader.altitude_m - now.pursuer.altitude_m);
  const { colour } = age;
  const lines = [
    { text: ident, colour },
    { text: `${height} ${shown.numbers.value.leaderSpeed}`, colour },
  ];
  if (age.showsAge) lines.push({ text: `${ageSeconds} S`, colour });
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

/** Height over the own ship in hundreds of feet with its sign, e.g. "+00", "−12". `height` [m] */
export function relativeAltitude(height: number): string {
  const hundreds = Math.round(height / FT / 100) + 0;
  return `${hundreds < 0 ? "−" : "+"}${String(Math.abs(hundreds)).padStart(2, "0")}`;
}
