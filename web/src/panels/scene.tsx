/** The 3D scene beside the ND: the same flight, seen from anywhere. */

import { useComputed } from "@preact/signals";
import { Icon } from "../parts";
import type { Session } from "../session";

export function Scene(props: { session: Session }) {
  const { flight, status, sceneMaximised } = props.session;
  // Loaded only once the flight flies: the scene's page has 0.8 MB, and its picture costs GPU time.
  const flying = useComputed(() => flight.sample.value !== null);
  const url = status.value?.scene_url;
  const maximised = sceneMaximised.value;
  return (
    <section class="scene" aria-labelledby="scene-title">
      <header>
        <h2 id="scene-title">3D scene</h2>
        <ul class="legend" aria-label="Legend of the 3D scene">
          <li class="key-pursuer">own</li>
          <li class="key-plan">plan</li>
          <li class="key-leader">leader</li>
          <li class="key-slot">slot</li>
          <li class="key-min">MIN</li>
        </ul>
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
        {flying.value && url !== undefined ? (
          <iframe key={url} src={url} title="3D scene of the flight: drag to turn, wheel to zoom" />
        ) : (
          <p>The scene opens with the first position.</p>
        )}
      </div>
    </section>
  );
}
