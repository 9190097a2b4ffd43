/**
 * The 3D scene beside the ND: the same flight, seen from anywhere. Live it is the server's own picture;
 * of any other instant, of two flights, of a recording, and until the server's is there, the page draws it.
 */

import {
  type ReadonlySignal,
  type Signal,
  useComputed,
  useSignal,
  useSignalEffect,
} from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Icon, Maximise, set } from "../parts";
import type { Actions, Session } from "../session";
import type { Shown } from "../store/shown";
import { SceneBar } from "./bar";
import {
  type Camera,
  cameraAt,
  type Stand,
  standFor,
  standOf,
  turned,
  VIEWS,
  type ViewName,
  zoomed,
} from "./camera";
import type { Size } from "./glass";
import { Poster, sightsOf } from "./poster";
import { dress, isDark, listen, press } from "./server-page";
import { Writing } from "./writing";
import "./scene.css";

/** What each view shows. */
const SHOWS: Record<ViewName, string> = {
  Chase: "Behind own ship, towards the leader",
  Top: "From above, north up",
  Side: "From the right, down to the ground",
  Free: "Where you put it: drag to turn, wheel to zoom",
};
/** How often it is looked whether the server's picture is drawn [ms]. */
const LOOK = 200;

interface Props {
  readonly session: Session;
  readonly actions: Actions;
}

export function Scene({ session, actions }: Props) {
  const { shown, status, sceneMaximised } = session;
  // Loaded only once the flight flies: the scene's page has 0.8 MB, and its picture costs GPU time.
  const flying = useComputed(() => shown.picture.value.pose !== null);
  const url = status.value?.scene_url;
  const maximised = sceneMaximised.value;
  const frame = useRef<HTMLIFrameElement>(null);
  const isDrawn = useSignal(false);
  // The server's picture knows no other instant than the newest, and no other flight.
  const isLive = useComputed(
    () => session.flight.source.value.kind === "live" && shown.ghost.value === null,
  );
  const view = useSignal<ViewName>("Chase");
  const camera = useSignal<Camera | null>(null);
  const size = useSignal<Size>({ width: 0, height: 0 });
  const isOpen = flying.value && url !== undefined;
  const isPosted = useComputed(() => !isDrawn.value || !isLive.value);
  const own = useOwnCamera({ shown, view, camera, size, isPosted });
  // A hand that turned the page's picture has not turned the server's: there the view begins anew.
  useSignalEffect(() => {
    if (isPosted.value || !own.isTurned()) return;
    view.value = "Chase";
    press(frame.current?.contentDocument ?? null, "Chase");
  });
  const seen = useComputed(() => (isPosted.value ? own.camera.value : camera.value));
  useEffect(() => {
    isDrawn.value = false;
    camera.value = null;
    view.value = "Chase";
    if (!isOpen || url === undefined) return;
    const timer = setInterval(() => {
      const page = frame.current?.contentDocument ?? null;
      if (!dress(page)) return;
      listen(page, camera, view);
      // After the scene's own drawing of the same frame: only then can its picture be read.
      page?.defaultView?.requestAnimationFrame(() => {
        if (!isDark(page)) return;
        isDrawn.value = true;
        clearInterval(timer);
        press(page, view.peek());
      });
    }, LOOK);
    return () => clearInterval(timer);
  }, [url, isOpen, isDrawn, camera, view]);
  return (
    <section class="scene" aria-labelledby="scene-title">
      <header>
        <h2 id="scene-title">3D scene</h2>
        <fieldset class="choice views">
          <legend class="visually-hidden">Where the scene is seen from</legend>
          {VIEWS.map((each) => (
            <button
              type="button"
              key={each}
              title={SHOWS[each]}
              aria-pressed={view.value === each}
              disabled={!flying.value}
              onClick={() => {
                if (each === "Free") own.hold();
                view.value = each;
                press(frame.current?.contentDocument ?? null, each);
              }}
            >
              {each}
            </button>
          ))}
        </fieldset>
        <button
          type="button"
          class="quiet"
          title="The flight over time, in the scene's place (G)"
          onClick={set(session.chartsOpen, true)}
        >
          <Icon name="charts" />
          Charts
        </button>
        <Maximise on={sceneMaximised} />
      </header>
      {maximised && <SceneBar session={session} actions={actions} />}
      <div class="scene-glass">
        {isOpen && (
          <iframe
            key={url}
            ref={frame}
            class={isLive.value ? "" : "behind"}
            src={url}
            title="3D scene of the flight: drag to turn, wheel to zoom"
          />
        )}
        {flying.value && isPosted.value && (
          <Poster shown={shown} camera={own.camera} size={size} turn={own.turn} zoom={own.zoom} />
        )}
        {!flying.value && <p class="scene-waits">The scene opens with the first position.</p>}
        {flying.value && <Writing shown={shown} camera={seen} size={size} />}
      </div>
    </section>
  );
}

interface OwnCamera {
  readonly camera: ReadonlySignal<Camera | null>;
  /** Leaves it where it is, to be turned by hand. */
  hold(): void;
  /** Whether a hand has put it where it is. */
  isTurned(): boolean;
  turn(right: number, down: number): void;
  zoom(factor: number): void;
}

interface Looking {
  readonly shown: Shown;
  readonly view: Signal<ViewName>;
  /** The server's. */
  readonly camera: ReadonlySignal<Camera | null>;
  readonly size: ReadonlySignal<Size>;
  readonly isPosted: ReadonlySignal<boolean>;
}

/** The camera of the picture that the page draws: where the view has it, or where a hand has put it. */
function useOwnCamera({ shown, view, camera, size, isPosted }: Looking): OwnCamera {
  const held = useSignal<Stand | null>(null);
  const byHand = useRef(false);
  const aspect = useComputed(() => size.value.width / Math.max(1, size.value.height));
  const stand = useComputed(() => {
    if (!isPosted.value || size.value.height === 0) return null;
    const chosen = view.value;
    if (chosen === "Free" && held.value !== null) return held.value;
    const sights = sightsOf(shown.picture.value, shown.ghost.value);
    if (sights === null) return null;
    return standFor(chosen === "Free" ? "Chase" : chosen, sights, aspect.value);
  });
  // From the server's picture a camera that a hand has moved is taken over as it stands.
  useSignalEffect(() => {
    if (!isPosted.value || view.peek() !== "Free") return;
    const [from, pose] = [camera.peek(), shown.picture.peek().pose];
    if (from !== null && pose !== null) held.value = standOf(from, pose.altitude_m);
    byHand.current = false;
  });
  const move = (moved: (stand: Stand) => Stand) => {
    const from = stand.peek();
    if (from === null) return;
    held.value = moved(from);
    byHand.current = true;
    view.value = "Free";
  };
  return {
    camera: useComputed(() => (stand.value === null ? null : cameraAt(stand.value, aspect.value))),
    hold: () => {
      held.value = stand.peek() ?? held.peek();
    },
    isTurned: () => byHand.current && view.peek() === "Free",
    turn: (right, down) => move((from) => turned(from, right, down)),
    zoom: (factor) => move((from) => zoomed(from, factor)),
  };
}
