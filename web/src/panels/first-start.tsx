/** One quiet line while a first start prepares the planner; it goes when that is done. */

import type { Signal } from "@preact/signals";
import type { Readiness } from "../api";
import { firstStartText } from "../first-start";

export function FirstStart(props: { readiness: Signal<Readiness | null> }) {
  const text = firstStartText(props.readiness.value);
  if (text === "") return null;
  return (
    <p
      class="first-start"
      title="Once on each machine; what flies is ready, and what needs more waits for it."
    >
      {text}
    </p>
  );
}
