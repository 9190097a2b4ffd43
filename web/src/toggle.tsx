/** A button that switches one thing of the page, or opens what belongs to it. */

import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";

export function Toggle(props: {
  on: Signal<boolean>;
  /** Whether something opens: then it is said to be expanded, else pressed. */
  opens?: boolean;
  children: ComponentChildren;
}) {
  const { on, opens = false } = props;
  return (
    <button
      type="button"
      class="quiet"
      {...{ [opens ? "aria-expanded" : "aria-pressed"]: on.value }}
      onClick={() => {
        on.value = !on.value;
      }}
    >
      {props.children}
    </button>
  );
}
