/**
 * How often the picture is drawn: again once something on the glass has moved by as much as can be
 * seen, once there is news, and as often as numbers are read. In between nothing is touched.
 */

import { batch } from "@preact/signals";
import { velocity } from "./geometry";
import { type Layout, layoutOf } from "./nd/view";
import type { Session } from "./session";
import type { FlightStore } from "./store/flight";
import type { PairSample } from "./store/pair";
import { DEG } from "./units";
import type { AircraftSample, Tick } from "./wire";

/** What moves by less than this looks still, and what moves in steps of this glides [px]. */
const STEP = 0.33;
/** Numbers are read this often, whatever moves [ms]. */
const LONGEST = 200;
/** The screen's own period: sooner than this there is no next picture [ms]. */
const FRAME = 16;

interface Arrived {
  readonly tick: Tick;
  readonly wall: number;
}

/** Draws the session's picture at its own pace. What it returns takes the ticks that arrive. */
export function drawPictures(
  store: FlightStore,
  { shown, flight, ndMode, ndRange }: Session,
): (tick: Tick, wall: number) => void {
  let arrived: Arrived[] = [];
  let timer: ReturnType<typeof setTimeout> | null = null;

  function draw(wall: number): void {
    batch(() => {
      for (const each of arrived) store.receive(each.tick, each.wall);
      arrived = [];
      store.advance(wall);
    });
    const { paused, ended, rate } = flight.clock.value;
    const speed = paused || ended ? 0 : rate;
    const layout = layoutOf(ndMode.value, ndRange.value);
    const wait = patience(shown.picture.value.now, layout, speed);
    timer = setTimeout(request, Math.max(0, wait - FRAME));
  }

  function request(): void {
    timer = null;
    // Nobody sees a hidden page, and it is given no frames: its alerts are heard nevertheless.
    if (document.hidden) draw(performance.now());
    else requestAnimationFrame(draw);
  }

  request();
  return (tick, wall) => {
    arrived.push({ tick, wall });
    if (timer === null || !isNews(tick)) return;
    clearTimeout(timer);
    request();
  };
}

/** How long the picture may stand still [ms]. */
export function patience(now: PairSample | null, layout: Layout, rate: number): number {
  if (now === null) return LONGEST;
  return Math.min(LONGEST, (1000 * STEP) / (rate * fastest(now, layout)));
}

/** How fast anything moves on the glass [px per second of flight]. */
function fastest({ pursuer, leader }: PairSample, layout: Layout): number {
  const [own, other] = [overGround(pursuer), overGround(leader)];
  const past = Math.hypot(own.x - other.x, own.y - other.y);
  const along = Math.max(past, pursuer.ground_speed_mps, leader.ground_speed_mps) * layout.scale;
  return along + Math.abs(pursuer.turn_rate_degps) * DEG * layout.tape;
}

function overGround({ ground_speed_mps, track_deg }: AircraftSample) {
  return velocity(ground_speed_mps, track_deg);
}

function isNews({ documents }: Tick): boolean {
  return documents.some(({ kind }) => kind !== "sample");
}
