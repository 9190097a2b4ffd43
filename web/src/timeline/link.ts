/** Links to an instant: `?flight=…&t=560&nd=ARC&range=40` is what is shown, and shows it again. */

import { computed, effect } from "@preact/signals";
import { ND_RANGES, type Session } from "../session";

/** Browsers take so many changes of the address and no more: it follows when the hand rests [ms]. */
const REST = 300;

/** Shows the display as a link has it: mode and range. */
export function lookAs({ ndMode, ndRange, ndAuto }: Session, link: URLSearchParams): void {
  const mode = link.get("nd");
  if (mode === "ARC" || mode === "ROSE") ndMode.value = mode;
  else if (ndMode.value === "PLAN" && !link.has("plan")) ndMode.value = "ARC";
  const range = ND_RANGES.find((each) => String(each) === link.get("range"));
  if (range === undefined) return;
  ndAuto.value = false;
  ndRange.value = range;
}

/** Keeps the instant, the mode and a range that was chosen in the page's address. */
export function followInstant(session: Session): void {
  const { flight, ndMode, ndAuto, ndRange } = session;
  let timer: ReturnType<typeof setTimeout> | undefined;
  // A flight that flies on draws the instant that stands again and again.
  const standing = computed(() => {
    const { source, moment } = flight;
    const isStanding = source.value.kind === "replay" && source.value.rate === 0;
    return isStanding ? String(Math.round(moment.value.t * 10) / 10) : null;
  });
  const chosen = computed(() =>
    ndAuto.value || ndMode.value === "PLAN" ? null : String(ndRange.value),
  );
  const write = () => {
    // What a link asks for stays there until it is shown.
    if (session.isOpening.value) return;
    const address = new URL(location.href);
    const before = address.href;
    const put = (name: string, value: string | null) => {
      if (value === null) address.searchParams.delete(name);
      else address.searchParams.set(name, value);
    };
    if (!["flight", "compare"].some((name) => address.searchParams.has(name))) return;
    put("t", standing.value);
    put("nd", ndMode.value === "ROSE" ? "ROSE" : null);
    put("range", chosen.value);
    if (address.href !== before) history.replaceState(history.state, "", address);
  };
  effect(() => {
    void [standing.value, ndMode.value, chosen.value, session.isOpening.value];
    clearTimeout(timer);
    timer = setTimeout(write, REST);
  });
}
