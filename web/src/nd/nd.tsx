/** The navigation display: all layers, bottom to top, round one projection. */

import { type Signal, useComputed } from "@preact/signals";
import type { ComponentType } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import type { Shown } from "../store/shown";
import { AirData } from "./air";
import { OrderStatus } from "./atc";
import { CapturePoint } from "./capture";
import { SeparationCircle } from "./circle";
import { ClosestApproach } from "./closest";
import { CommandedHeading, CommandedTurn } from "./commanded";
import { CrossTrack } from "./crosstrack";
import { Fan } from "./fan";
import { FinalTrack } from "./final";
import { Flags } from "./flags";
import { ModeStrip } from "./fma";
import { OtherFlight } from "./ghost";
import { LeaderHistory } from "./history";
import { LeaderIntent } from "./intent";
import { CarriedLabels, Labels } from "./labelled";
import { type LayerProps, usePart } from "./layer";
import { Leader } from "./leader";
import { MarginCircle } from "./margin";
import { MessageLine } from "./message";
import { TimeTicks } from "./minutes";
import { NextPoint } from "./next";
import { OffScaleLeader } from "./offscale";
import { OwnShip } from "./ownship";
import { ActivePath, SupersededPath } from "./plan";
import { Plane } from "./plane";
import { OtherPaths, ProposedPath } from "./proposal";
import { RangeRings } from "./rings";
import { Rivals } from "./rivals";
import { Slot } from "./slot";
import { Spacing } from "./spacing";
import { HeadingTape, LubberLine } from "./tape";
import { TimingScale } from "./timing";
import { TrackDiamond, TrackLine } from "./track";
import { OffScaleTraffic, TrafficSymbol, TrafficSymbols } from "./traffic";
import { TrendVector } from "./trend";
import { Tube } from "./tube";
import { TurnPoints } from "./turns";
import { type Carrier, createView, type DisplayMode, SIZE } from "./view";
import { Weather } from "./weather";

/** What lies under the map: no path is ever covered by it. */
export const GROUND_LAYERS = [RangeRings, TrackLine, TrendVector] as const;

interface Sheet {
  readonly by: Carrier;
  readonly layers: readonly ComponentType<LayerProps>[];
}

/** The world, bottom to top, by what each part of it moves with. */
const MAP_SHEETS: readonly Sheet[] = [
  { by: "map", layers: [Weather, OtherFlight, LeaderIntent, LeaderHistory, Fan] },
  { by: "leader", layers: [SeparationCircle, MarginCircle] },
  {
    by: "map",
    layers: [
      FinalTrack,
      Tube,
      Rivals,
      OtherPaths,
      SupersededPath,
      ProposedPath,
      ActivePath,
      TimeTicks,
      TurnPoints,
    ],
  },
  { by: "slot", layers: [Slot] },
  { by: "map", layers: [CapturePoint, ClosestApproach] },
];
const LEADER_SHEET: Sheet = { by: "leader", layers: [Leader] };
export const MAP_LAYERS = [
  ...MAP_SHEETS.flatMap(({ layers }) => layers),
  TrafficSymbols,
  ...LEADER_SHEET.layers,
];

/** What stands on the glass over the map, bottom to top: under the labels, and over them. */
const UNDER_LABELS: readonly Sheet[] = [
  { by: "glass", layers: [OwnShip] },
  { by: "tape", layers: [OffScaleLeader, OffScaleTraffic, HeadingTape, CommandedHeading] },
  { by: "glass", layers: [CommandedTurn, LubberLine, TrackDiamond] },
];
const OVER_LABELS: Sheet = {
  by: "glass",
  layers: [
    CrossTrack,
    AirData,
    NextPoint,
    Spacing,
    TimingScale,
    ModeStrip,
    OrderStatus,
    Flags,
    MessageLine,
  ],
};
export const GLASS_LAYERS = [
  ...UNDER_LABELS.flatMap(({ layers }) => layers),
  Labels,
  ...OVER_LABELS.layers,
];

interface Props {
  readonly shown: Shown;
  readonly mode: Signal<DisplayMode>;
  /** NM. */
  readonly range: Signal<number>;
  /** Designates the leader, when its symbol is clicked on. */
  readonly designate?: () => void;
}

export function NavigationDisplay({ shown, mode, range, designate }: Props) {
  const view = useMemo(() => createView(shown, mode, range), [shown, mode, range]);
  const label = useComputed(() => {
    const { mode, range } = view.layout.value;
    const head = `Navigation display, ${mode}, range ${range} nautical miles.`;
    return `${head} ${shown.words.value}`;
  });
  const glass = useRef<HTMLDivElement>(null);
  // The keyboard designates by a button beside the glass, or by a key.
  useEffect(() => {
    const click = (event: MouseEvent) => {
      const target = event.target;
      if (!(target instanceof Element)) return;
      const ident = target.closest("[data-ident]")?.getAttribute("data-ident");
      if (ident != null) choose(shown, ident);
      else if (target.closest(".nd-leader, .nd-offscale") !== null) designate?.();
    };
    const { current } = glass;
    current?.addEventListener("click", click);
    return () => current?.removeEventListener("click", click);
  }, [designate, shown]);
  const drawn = { shown, view };
  return (
    <div ref={glass} class="nd nd-display" role="img" aria-label={label}>
      <Layers {...drawn} by="glass" layers={GROUND_LAYERS} />
      <WorldMap {...drawn} />
      {UNDER_LABELS.map((sheet, i) => (
        <Layers key={i} {...drawn} {...sheet} />
      ))}
      <CarriedLabels {...drawn} />
      <Layers {...drawn} {...OVER_LABELS} />
    </div>
  );
}

/** Shows the numbers of another aircraft, or of none if they are shown already. */
export function choose({ chosen }: Shown, ident: string): void {
  chosen.value = chosen.value === ident ? null : ident;
}

function Layers({ shown, view, by, layers }: LayerProps & Sheet) {
  return (
    <Plane shown={shown} view={view} by={by}>
      {layers.map((Layer) => (
        <Layer key={Layer.name} shown={shown} view={view} />
      ))}
    </Plane>
  );
}

/** The world, cut to the tape. */
function WorldMap({ shown, view }: LayerProps) {
  const isShown = usePart(shown, ({ now }) => now !== null);
  const idents = useComputed(() =>
    shown.picture.value.traffic.map(({ ident }) => ident).join("\n"),
  );
  const { centre, tape } = view.layout.value;
  if (!isShown.value) return null;
  const part = (length: number) => `${(100 * length) / SIZE}%`;
  const cut = `circle(${part(tape)} at ${part(centre.x)} ${part(centre.y)})`;
  return (
    <div class="nd-map" style={{ clipPath: cut }}>
      {MAP_SHEETS.map((sheet, i) => (
        <World key={i} shown={shown} view={view} {...sheet} />
      ))}
      {idents.value
        .split("\n")
        .filter(Boolean)
        .map((ident) => (
          <Plane key={ident} shown={shown} view={view} by={`other ${ident}`}>
            <g class="nd-world" transform={view.mapTransform}>
              <TrafficSymbol shown={shown} view={view} ident={ident} />
            </g>
          </Plane>
        ))}
      <World shown={shown} view={view} {...LEADER_SHEET} />
    </div>
  );
}

function World({ shown, view, by, layers }: LayerProps & Sheet) {
  return (
    <Plane shown={shown} view={view} by={by}>
      <g class="nd-world" transform={view.mapTransform}>
        {layers.map((Layer) => (
          <Layer key={Layer.name} shown={shown} view={view} />
        ))}
      </g>
    </Plane>
  );
}
