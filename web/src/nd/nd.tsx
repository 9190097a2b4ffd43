/** The navigation display: all layers, bottom to top, round one projection. */

import { type Signal, useComputed } from "@preact/signals";
import { useEffect, useId, useMemo, useRef } from "preact/hooks";
import type { Shown } from "../store/picture";
import { AirData } from "./air";
import { OrderStatus } from "./atc";
import { CapturePoint } from "./capture";
import { SeparationCircle } from "./circle";
import { ClosestApproach } from "./closest";
import { Commanded } from "./commanded";
import { CrossTrack } from "./crosstrack";
import { FinalTrack } from "./final";
import { Flags } from "./flags";
import { ModeStrip } from "./fma";
import { LeaderHistory } from "./history";
import { LeaderIntent } from "./intent";
import { Labels } from "./labelled";
import { type LayerProps, usePart } from "./layer";
import { Leader } from "./leader";
import { MessageLine } from "./message";
import { TimeTicks } from "./minutes";
import { NextPoint } from "./next";
import { OffScaleLeader } from "./offscale";
import { OwnShip } from "./ownship";
import { ActivePath, SupersededPath } from "./plan";
import { OtherPaths, ProposedPath } from "./proposal";
import { RangeRings } from "./rings";
import { Slot } from "./slot";
import { Spacing } from "./spacing";
import { HeadingTape, LubberLine } from "./tape";
import { TimingScale } from "./timing";
import { TrackDiamond, TrackLine } from "./track";
import { TrendVector } from "./trend";
import { TurnPoints } from "./turns";
import "./nd.css";
import { createView, type DisplayMode, SIZE } from "./view";

/** What lies under the map: no path is ever covered by it. */
export const GROUND_LAYERS = [RangeRings, TrackLine, TrendVector] as const;

/** What turns and moves with the world, bottom to top. */
export const MAP_LAYERS = [
  LeaderIntent,
  LeaderHistory,
  SeparationCircle,
  FinalTrack,
  OtherPaths,
  SupersededPath,
  ProposedPath,
  ActivePath,
  TimeTicks,
  TurnPoints,
  Slot,
  CapturePoint,
  ClosestApproach,
  Leader,
] as const;

/** What stands on the glass over the map, bottom to top. */
export const GLASS_LAYERS = [
  OwnShip,
  OffScaleLeader,
  HeadingTape,
  Commanded,
  LubberLine,
  TrackDiamond,
  Labels,
  CrossTrack,
  AirData,
  NextPoint,
  Spacing,
  TimingScale,
  ModeStrip,
  OrderStatus,
  Flags,
  MessageLine,
] as const;

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
  const glass = useRef<SVGSVGElement>(null);
  // The keyboard designates by a button beside the glass, or by a key.
  useEffect(() => {
    const click = (event: MouseEvent) => {
      const target = event.target;
      if (target instanceof Element && target.closest(".nd-leader, .nd-offscale") !== null)
        designate?.();
    };
    const { current } = glass;
    current?.addEventListener("click", click);
    return () => current?.removeEventListener("click", click);
  }, [designate]);
  return (
    <svg ref={glass} class="nd" viewBox={`0 0 ${SIZE} ${SIZE}`} role="img" aria-label={label}>
      {GROUND_LAYERS.map((Layer) => (
        <Layer key={Layer.name} shown={shown} view={view} />
      ))}
      <WorldMap shown={shown} view={view} />
      {GLASS_LAYERS.map((Layer) => (
        <Layer key={Layer.name} shown={shown} view={view} />
      ))}
    </svg>
  );
}

/** The world, cut to the tape, carried by one transform a frame. */
function WorldMap({ shown, view }: LayerProps) {
  const clip = useId();
  const isShown = usePart(shown, ({ now }) => now !== null);
  const { centre, tape } = view.layout.value;
  if (!isShown.value) return null;
  return (
    <g clip-path={`url(#${clip})`}>
      <clipPath id={clip}>
        <circle cx={centre.x} cy={centre.y} r={tape} />
      </clipPath>
      <g class="nd-map" transform={view.mapTransform}>
        {MAP_LAYERS.map((Layer) => (
          <Layer key={Layer.name} shown={shown} view={view} />
        ))}
      </g>
    </g>
  );
}
