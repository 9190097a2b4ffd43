/**
 * How often the picture is drawn, and how often what is drawn is moved.
 *
 * Drawing finds places and numbers anew, and makes the browser lay out what has changed: five times a
 * second, with news at once, and sooner where a picture cannot be carried on. Between two pictures
 * the glass is carried on as far as all has moved, which lays out nothing: once that can be seen.
 */

import { batch } from "@preact/signals";
import { velocity } from "./geometry";
import { type Layout, layoutOf } from "./nd/view";
import type { Session } from "./session";
import { type FlightStore, READING_PERIOD, speedOf } from "./store/flight";
import { isEvent } from "./store/history";
import type { PairSample } from "./store/pair";
import { DEG } from "./units";
import type { AircraftSample, Tick } from "./wire";

/** What moves by less than this looks still, and what moves in steps of this glides [px]. */
const STEP = 0.33;
/** The screen's own period: sooner than this there is no next picture [ms]. */
const FRAME = 16;
/** Flown paths end under the own ship's symbol, whose tail is longer than this [px]. */
const FLOWN = 6;
/** Symbols keep the direction in which they were drawn: by this much it cannot be seen [deg]. */
const TURNED = 0.5;

interface Arrived {
  readonly tick: Tick;
  readonly wall: number;
}

/** Draws and moves the session's picture at its own pace. What it returns takes the ticks that arrive. */
export function drawPictures(
  store: FlightStore,
  { shown, flight, ndMode, ndRange, recording }: Session,
): (tick: Tick, wall: number) => void {
  let arrived: Arrived[] = [];
  let timer: ReturnType<typeof setTimeout> | null = null;
  let due = Number.NEGATIVE_INFINITY;

  function draw(wall: number): void {
    batch(() => {
      // What was on its way when a recording took the flight's place is not shown any more.
      if (recording.value === null) for (const each of arrived) store.receive(each.tick, each.wall);
      arrived = [];
      store.advance(wall);
    });
    const { layout, speed } = motion();
    due = wall + lifetime(shown.picture.value.now, layout, speed);
  }

  function frame(wall: number): void {
    if (wall >= due - FRAME / 2 || arrived.some(({ tick }) => isNews(tick))) draw(wall);
    else store.glide(wall);
    const { layout, speed } = motion();
    const wait = Math.min(patience(shown.picture.value.now, layout, speed), due - wall);
    // A frame that is asked for in time has the time of the one before; the next one needs no timer.
    timer = setTimeout(request, wait < 1.5 * FRAME ? 0 : wait);
  }

  function motion() {
    return { layout: layoutOf(ndMode.value, ndRange.value), speed: speedOf(flight) };
  }

  function request(): void {
    timer = null;
    // Nobody sees a hidden page, and it is given no frames: its alerts are heard nevertheless.
    if (document.hidden) frame(performance.now());
    else requestAnimationFrame(frame);
  }

  request();
  return (tick, wall) => {
    flight.heard.value = { tick, wall };
    arrived.push({ tick, wall });
    if (timer === null || !isNews(tick)) return;
    clearTimeout(timer);
    request();
  };
}

/** How long the glass may stand still [ms]. */
export function patience(now: PairSample | null, layout: Layout, rate: number): number {
  if (now === null) return READING_PERIOD;
  return Math.min(READING_PERIOD, (1000 * STEP) / (rate * fastest(now, layout)));
}

/** How long a picture may be carried on before it is drawn anew [ms]. */
export function lifetime(now: PairSample | null, layout: Layout, rate: number): number {
  if (now === null) return READING_PERIOD;
  const { pursuer, leader } = now;
  const flown = Math.max(pursuer.ground_speed_mps, leader.ground_speed_mps) * layout.scale;
  const turned = Math.max(Math.abs(pursuer.turn_rate_degps), Math.abs(leader.turn_rate_degps));
  const seconds = Math.min(FLOWN / (rate * flown), TURNED / (rate * turned));
  return Math.min(READING_PERIOD, 1000 * seconds);
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
  return documents.some(isEvent);
}
