/** The 3D scene beside the ND: the same flight, seen from anywhere. */

import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Icon } from "../parts";
import type { Session } from "../session";

/** Where the camera can be put, by the names of the scene's own views. */
const VIEWS = ["Overview", "From above", "From the side"] as const;
/** What the scene's page shows besides the picture: it has a place in ours, or none. */
const CHROME = "[class*=Notification], [class*=Paper-root] { display: none !important }";
/** How often it is looked whether the scene is drawn [ms]. */
const LOOK = 200;

export function Scene(props: { session: Session }) {
  const { shown, status, sceneMaximised } = props.session;
  // Loaded only once the flight flies: the scene's page has 0.8 MB, and its picture costs GPU time.
  const flying = useComputed(() => shown.picture.value.pose !== null);
  const url = status.value?.scene_url;
  const maximised = sceneMaximised.value;
  const frame = useRef<HTMLIFrameElement>(null);
  const isDrawn = useSignal(false);
  const isOpen = flying.value && url !== undefined;
  useEffect(() => {
    isDrawn.value = false;
    if (!isOpen || url === undefined) return;
    const timer = setInterval(() => {
      if (!dress(frame.current?.contentDocument ?? null)) return;
      isDrawn.value = true;
      clearInterval(timer);
    }, LOOK);
    return () => clearInterval(timer);
  }, [url, isOpen, isDrawn]);
  return (
    <section class="scene" aria-labelledby="scene-title">
      <header>
        <h2 id="scene-title">3D scene</h2>
        <fieldset class="choice views">
          <legend class="visually-hidden">Where the scene is seen from</legend>
          {VIEWS.map((view) => (
            <button
              type="button"
              key={view}
              disabled={!isDrawn.value}
              onClick={() => look(frame.current?.contentDocument ?? null, view)}
            >
              {view}
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
        {!isDrawn.value && (
          <p class="poster">
            {isOpen ? "The scene is being drawn." : "The scene opens with the first position."}
          </p>
        )}
      </div>
    </section>
  );
}

/** Takes the chrome off the scene's page, which is our own server's. Whether its picture is there. */
function dress(page: Document | null): boolean {
  const isThere = [...(page?.querySelectorAll("canvas") ?? [])].some(({ width }) => width > 1);
  if (page === null || !isThere) return false;
  const style = page.createElement("style");
  style.textContent = CHROME;
  page.body.append(style);
  return true;
}

/** Presses the scene's own button of a view. */
function look(page: Document | null, view: (typeof VIEWS)[number]): void {
  const buttons = [...(page?.querySelectorAll("button") ?? [])];
  buttons.find((button) => button.textContent === view)?.click();
}
