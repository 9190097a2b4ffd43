/** The 3D scene beside the ND: the same flight, seen from anywhere. */

import { type Signal, useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Icon } from "../parts";
import type { Session } from "../session";
import type { Camera } from "./camera";
import { Poster, posterCamera } from "./poster";
import type { Size } from "./texts";
import { Writing } from "./writing";

/** Where the camera can be put, by the names of the scene's own views. */
const VIEWS = ["Chase", "Top", "Side", "Free"] as const;
type ViewName = (typeof VIEWS)[number];
/** What each of them shows. */
const SHOWS: Record<ViewName, string> = {
  Chase: "Behind own ship, towards the leader",
  Top: "From above, north up",
  Side: "With both aircraft side by side",
  Free: "Where you put it: drag to turn, wheel to zoom",
};
/** What the scene's page shows besides the picture: it has a place in ours, or none. */
const CHROME = "[class*=Notification], [class*=Paper-root] { display: none !important }";
/** How often it is looked whether the scene is drawn [ms]. */
const LOOK = 200;
/** Its ground is dark: brighter than this is the vendor's empty page (0 to 255). */
const DARK = 160;
/** Where the picture is looked at, as parts of its sides. */
const PARTS = [0.1, 0.5, 0.9] as const;

export function Scene(props: { session: Session }) {
  const { shown, status, sceneMaximised } = props.session;
  // Loaded only once the flight flies: the scene's page has 0.8 MB, and its picture costs GPU time.
  const flying = useComputed(() => shown.picture.value.pose !== null);
  const url = status.value?.scene_url;
  const maximised = sceneMaximised.value;
  const frame = useRef<HTMLIFrameElement>(null);
  const isDrawn = useSignal(false);
  const view = useSignal<ViewName>("Chase");
  const camera = useSignal<Camera | null>(null);
  const size = useSignal<Size>({ width: 0, height: 0 });
  // The poster is drawn as often as numbers are read: it stands for seconds at most.
  const stand = useComputed(() => {
    void shown.numbers.value.readAt;
    return isDrawn.value ? null : posterCamera(shown.picture.peek(), size.value);
  });
  const seen = useComputed(() => (isDrawn.value ? camera.value : stand.value));
  const isOpen = flying.value && url !== undefined;
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
              disabled={!isDrawn.value}
              onClick={() => {
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
          aria-pressed={maximised}
          onClick={() => {
            sceneMaximised.value = !maximised;
          }}
        >
          <Icon name={maximised ? "restore" : "maximise"} />
          {maximised ? "Restore" : "Maximise"}
        </button>
      </header>
      <div class="scene-glass">
        {isOpen && (
          <iframe
            key={url}
            ref={frame}
            src={url}
            title="3D scene of the flight: drag to turn, wheel to zoom"
          />
        )}
        {!isDrawn.value && <Poster shown={shown} camera={stand} size={size} />}
        {!flying.value && <p class="scene-waits">The scene opens with the first position.</p>}
        {flying.value && <Writing shown={shown} camera={seen} size={size} />}
      </div>
    </section>
  );
}

/** Takes the chrome off the scene's page, which is our own server's. Whether it has a canvas. */
function dress(page: Document | null): page is Document {
  if (page === null || canvasOf(page) === null) return false;
  if (page.querySelector("style[data-dress]") !== null) return true;
  const style = page.createElement("style");
  style.dataset.dress = "";
  style.textContent = CHROME;
  page.body.append(style);
  return true;
}

/** Takes the camera of each picture, and notes when a hand moves it. */
function listen(page: Document, camera: Signal<Camera | null>, view: Signal<ViewName>): void {
  const window: (Window & { onpicture?: unknown }) | null = page.defaultView;
  if (window === null || window.onpicture !== undefined) return;
  window.onpicture = (projection: readonly number[], seen: readonly number[]) => {
    camera.value = { projection: [...projection], view: [...seen] };
  };
  const free = () => {
    if (view.value === "Free") return;
    view.value = "Free";
    press(page, "Free");
  };
  page.addEventListener("wheel", free, { passive: true });
  page.addEventListener("pointermove", ({ buttons }) => {
    if (buttons !== 0) free();
  });
}

function canvasOf(page: Document): HTMLCanvasElement | null {
  return [...page.querySelectorAll("canvas")].find(({ width }) => width > 1) ?? null;
}

/** Whether the scene's own ground is drawn, and no longer the empty page. */
function isDark(page: Document): boolean {
  const canvas = canvasOf(page);
  const glass = document.createElement("canvas");
  [glass.width, glass.height] = [PARTS.length, PARTS.length];
  const pen = glass.getContext("2d", { willReadFrequently: true });
  if (canvas === null || pen === null || isFading(canvas)) return false;
  for (const [i, x] of PARTS.entries())
    for (const [j, y] of PARTS.entries())
      pen.drawImage(canvas, x * canvas.width, y * canvas.height, 1, 1, i, j, 1, 1);
  const { data } = pen.getImageData(0, 0, PARTS.length, PARTS.length);
  let dark = 0;
  for (let at = 0; at < data.length; at += 4) {
    const [red = 0, green = 0, blue = 0, there = 0] = data.slice(at, at + 4);
    if (there > 200 && Math.max(red, green, blue) < DARK) dark += 1;
  }
  return dark > 5; // of nine: lines and labels may be bright
}

/** The vendor's page fades its canvas in: until then the poster is what can be seen. */
function isFading(canvas: HTMLCanvasElement): boolean {
  const style = canvas.ownerDocument.defaultView?.getComputedStyle(canvas);
  return Number(style?.opacity ?? 1) < 0.9;
}

/** Presses the scene's own button of a view. */
function press(page: Document | null, view: ViewName): void {
  const buttons = [...(page?.querySelectorAll("button") ?? [])];
  buttons.find((button) => button.textContent === view)?.click();
}
