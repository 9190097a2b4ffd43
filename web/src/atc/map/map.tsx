/** The map: one SVG that fills its place. */

import { useLayoutEffect, useRef } from "preact/hooks";
import { PairTool } from "../pair-tool";
import { type Station, tapOn } from "../station";
import { Dots, Symbols } from "./aircraft";
import { followGestures } from "./gestures";
import { Airspaces, Rings, Scale } from "./ground";
import { Labels } from "./labels";
import { Measure } from "./measure";
import { PairGeometry } from "./pair";
import { Routes } from "./routes";
import { keepInSight, showAll, zoom } from "./view";

export function SkyMap({ station }: { station: Station }) {
  const place = useRef<HTMLDivElement>(null);
  const { view } = station;
  useLayoutEffect(() => {
    const glass = place.current;
    const drawing = glass?.querySelector("svg");
    if (glass === null || drawing === null || drawing === undefined) return;
    const measure = () => {
      const { clientWidth: width, clientHeight: height } = glass;
      if (width === 0 || height === 0) return;
      view.size.value = { width, height };
      keepInSight(view, station.store.sky.value.aircraft);
    };
    measure();
    const watcher = new ResizeObserver(measure);
    watcher.observe(glass);
    const undo = followGestures(drawing, view, (at) => tapOn(station, at));
    return () => {
      watcher.disconnect();
      undo();
    };
  }, [station, view]);
  const { width, height } = view.size.value;
  const { aircraft, title } = station.store.sky.value;
  return (
    <section class="atc-map" aria-label="Map">
      <div class="atc-glass" ref={place}>
        <svg
          viewBox={`0 0 ${width} ${height}`}
          role="img"
          aria-label={`${title}: ${aircraft.length} aircraft`}
        >
          <Rings station={station} />
          <Airspaces station={station} />
          <Routes station={station} />
          <Dots station={station} />
          <PairGeometry station={station} />
          <Measure station={station} />
          <Symbols station={station} />
          <Labels station={station} />
          <Scale station={station} />
        </svg>
      </div>
      {station.pairToolOpen.value && <PairTool station={station} />}
      <div class="atc-zoom">
        <button type="button" aria-label="Zoom in" onClick={() => zoom(view, 1.5)}>
          +
        </button>
        <button type="button" aria-label="Zoom out" onClick={() => zoom(view, 1 / 1.5)}>
          −
        </button>
        <button type="button" onClick={() => showAll(view, station.store.sky.value.aircraft)}>
          Fit
        </button>
      </div>
    </section>
  );
}
