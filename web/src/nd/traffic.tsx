import { useComputed } from "@preact/signals";
import type { Colour } from "../store/colours";
import type { Traffic, Urgency } from "../store/traffic";
import { FT, formatClock, formatKnots, formatMiles } from "../units";
import type { Label } from "./labels";
import type { LayerProps } from "./layer";
import { relativeAltitude, trendSign } from "./leader";
import { ink } from "./style";
import { bearing, edge, type Layout, offNose, onMap, placeAt, project, toMap } from "./view";

/** Slimmer than the leader's: it is no more than seen. */
const CHEVRON = "M0 -13L8 10L0 5L-8 10Z";
const ARROW = { "↑": "M0 7V-7M-4 -2L0 -7L4 -2", "↓": "M0 -7V7M-4 2L0 7L4 2" } as const;
const DISC = 15;
const SQUARE = 15;
/** What may be clicked on: 24 px of the page on a small glass. */
const TOUCH = 26;
/** What is so much higher or lower is shown only when it matters [m]. */
const HEIGHT_SHOWN = 9900 * FT;
/** Beyond this range levels stand at what is near only, beyond this one idents do [NM]. */
const LEVELS_UP_TO = 80;
const IDENTS_UP_TO = 40;

export const TRAFFIC_COLOUR: Record<Urgency, Colour> = {
  other: "leader",
  proximate: "leader",
  caution: "caution",
  warning: "alert",
};

export function isUrgent({ urgency }: Traffic): boolean {
  return urgency === "caution" || urgency === "warning";
}

/** All other aircraft, the most urgent on top. */
export function TrafficSymbols(props: LayerProps) {
  const idents = useComputed(() =>
    props.shown.picture.value.traffic.map(({ ident }) => ident).join("\n"),
  );
  if (idents.value === "") return null;
  return (
    <>
      {idents.value.split("\n").map((ident) => (
        <TrafficSymbol key={ident} {...props} ident={ident} />
      ))}
    </>
  );
}

/** One of them: a chevron along its track, its level over own ship, and whether it climbs. */
export function TrafficSymbol({ shown, view, ident }: LayerProps & { ident: string }) {
  const seen = useComputed(() => seenOnMap({ shown, view }, ident));
  const isShown = useComputed(() => seen.value !== null);
  const place = useComputed(() => {
    const { value: traffic } = seen;
    if (traffic === null) return "";
    // upright, so that its level can be read
    return placeAt(toMap(view.layout.value, traffic.aircraft), view.pose.value?.heading_deg ?? 0);
  });
  const turn = useComputed(() => {
    const [traffic, pose] = [seen.value, view.pose.value];
    if (traffic === null || pose === null) return "";
    return `rotate(${Math.round(offNose(pose, traffic.aircraft.track_deg) * 10) / 10})`;
  });
  const urgency = useComputed(() => seen.value?.urgency ?? "other");
  const isChosen = useComputed(() => shown.chosen.value === ident);
  const level = useComputed(() => {
    const traffic = seen.value;
    if (traffic === null || !hasLevel(view.layout.value, traffic, isChosen.value)) return "";
    return relativeAltitude(traffic.height);
  });
  const trend = useComputed(() => (level.value === "" ? "" : trendSign(seen.value?.climb ?? 0)));
  if (!isShown.value) return null;
  const colour = ink(TRAFFIC_COLOUR[urgency.value]);
  const isAlerting = urgency.value === "caution" || urgency.value === "warning";
  const under = level.value.startsWith("−");
  const beside = under ? 33 : -20;
  return (
    <g class="nd-traffic" data-ident={ident} transform={place}>
      {isChosen.value && (
        <circle class="nd-stroke" r={22} stroke={ink("selected")} stroke-width={2} />
      )}
      {urgency.value === "caution" && <circle class="nd-solid" r={DISC} fill={colour} />}
      {urgency.value === "warning" && (
        <path
          class="nd-solid"
          d={`M${-SQUARE} ${-SQUARE}H${SQUARE}V${SQUARE}H${-SQUARE}Z`}
          fill={colour}
        />
      )}
      <g transform={turn}>
        {urgency.value === "other" ? (
          <path class="nd-hollow" d={CHEVRON} stroke={colour} stroke-width={2} />
        ) : (
          <path class="nd-solid" d={CHEVRON} fill={isAlerting ? "var(--glass)" : colour} />
        )}
      </g>
      {level.value !== "" && (
        <text class="nd-text" y={beside} font-size={17} text-anchor="middle" fill={colour}>
          {level}
        </text>
      )}
      {trend.value !== "" && (
        <g transform={`translate(27 ${beside - 6})`}>
          <path class="nd-halo" d={ARROW[trend.value]} stroke-width={5} />
          <path class="nd-stroke" d={ARROW[trend.value]} stroke={colour} stroke-width={2} />
        </g>
      )}
      <circle class="nd-touch" r={TOUCH} />
    </g>
  );
}

/** One of the others, when its symbol is drawn. */
function seenOnMap({ shown, view }: LayerProps, ident: string): Traffic | null {
  const [{ traffic }, pose] = [shown.picture.value, view.pose.value];
  const found = traffic.find((each) => each.ident === ident);
  if (found === undefined || pose === null) return null;
  const isFar = Math.abs(found.height) > HEIGHT_SHOWN;
  if (isFar && !isUrgent(found) && shown.chosen.value !== ident) return null;
  return onMap(view.layout.value, project(view.layout.value, pose, found.aircraft)) ? found : null;
}

function hasLevel({ range }: Layout, traffic: Traffic, isChosen: boolean): boolean {
  if (!Number.isFinite(traffic.height)) return false;
  return range <= LEVELS_UP_TO || traffic.urgency !== "other" || isChosen;
}

/** Who each is where there is room for it, and all that is known of the chosen one. */
export function trafficLabels({ shown, view }: LayerProps): Label[] {
  const [{ traffic }, pose] = [shown.picture.value, view.pose.value];
  if (pose === null) return [];
  const layout = view.layout.value;
  return [...traffic].reverse().flatMap((each): Label[] => {
    const { ident } = each;
    if (seenOnMap({ shown, view }, ident) === null) return [];
    const isChosen = shown.chosen.value === ident;
    const isNamed = isChosen || isUrgent(each) || layout.range <= IDENTS_UP_TO;
    if (!isNamed) return [];
    const colour = TRAFFIC_COLOUR[each.urgency];
    const at = project(layout, pose, each.aircraft);
    const lines = isChosen ? blockOf(each) : [ident];
    return [
      {
        id: trafficId(ident),
        at,
        lines: lines.map((text) => ({ text, colour })),
        side: at.x > layout.centre.x ? 90 : -90,
        gap: 24,
        size: 18,
        optional: !isChosen && !isUrgent(each),
      },
    ];
  });
}

/** Ident; distance and ground speed; closest approach if both fly straight on, and when. */
function blockOf({ ident, distance, aircraft, approach }: Traffic): string[] {
  const miles = `${formatMiles(distance)} NM ${formatKnots(aircraft.ground_speed_mps)} KT`;
  return [ident, miles, approachText(approach)];
}

function approachText(approach: Traffic["approach"]): string {
  if (approach.in <= 0) return "PARTING";
  return `CPA ${formatMiles(approach.least)} NM ${formatClock(approach.in)}`;
}

/** The name of a label: that of an aircraft, or of what stands for it on the edge. */
export function trafficId(ident: string, isOnEdge = false): string {
  return isOnEdge ? `traffic at the edge ${ident}` : `traffic ${ident}`;
}

/** Half a symbol on the edge, in the direction of an aircraft that alerts and is off the map. */
export function OffScaleTraffic({ shown, view }: LayerProps) {
  const marks = useComputed(() => offScale({ shown, view }));
  if (marks.value.length === 0) return null;
  return (
    <>
      {marks.value.map(({ traffic, direction }) => (
        <g
          key={traffic.ident}
          class="nd-traffic-edge"
          data-ident={traffic.ident}
          transform={placeAt(edge(view.layout.value, direction), direction)}
        >
          {traffic.urgency === "warning" ? (
            <path class="nd-solid" d="M-15 8V-8H15V8Z" fill={ink("alert")} />
          ) : (
            <path class="nd-solid" d="M-15 8A15 15 0 0 1 15 8Z" fill={ink("caution")} />
          )}
          <path class="nd-solid" d="M0 -4L6 6H-6Z" fill="var(--glass)" />
          <circle class="nd-touch" r={TOUCH} />
        </g>
      ))}
    </>
  );
}

interface OffScale {
  readonly traffic: Traffic;
  /** Right of the nose [deg]. */
  readonly direction: number;
}

function offScale({ shown, view }: LayerProps): OffScale[] {
  const [{ traffic }, pose] = [shown.picture.value, view.pose.value];
  if (pose === null) return [];
  return traffic
    .filter((each) => isUrgent(each) && seenOnMap({ shown, view }, each.ident) === null)
    .map((each) => ({
      traffic: each,
      direction: offNose(pose, bearing(pose, each.aircraft)),
    }));
}

export function offScaleTrafficLabels({ shown, view }: LayerProps): Label[] {
  const layout = view.layout.value;
  return offScale({ shown, view }).map(({ traffic, direction }) => {
    const colour = TRAFFIC_COLOUR[traffic.urgency];
    const text = `${relativeAltitude(traffic.height)} ${formatMiles(traffic.distance)}`;
    return {
      id: trafficId(traffic.ident, true),
      at: edge(layout, direction),
      lines: [
        { text: traffic.ident, colour },
        { text, colour },
      ],
      side: direction + 180,
      gap: 22,
      size: 18,
      optional: false,
    };
  });
}
