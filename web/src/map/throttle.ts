/** A signal that follows another at the pace of reading: what changes each frame is not read. */

import { effect, type ReadonlySignal, signal } from "@preact/signals";

/** Between two changes [ms]. */
const PERIOD = 200;

export function throttled<T>(quick: ReadonlySignal<T>): ReadonlySignal<T> {
  const slow = signal(quick.peek());
  let timer: ReturnType<typeof setTimeout> | undefined;
  let last = Number.NEGATIVE_INFINITY;
  const take = () => {
    timer = undefined;
    last = performance.now();
    slow.value = quick.peek();
  };
  effect(() => {
    void quick.value;
    if (timer !== undefined) return;
    const left = last + PERIOD - performance.now();
    if (left <= 0) take();
    else timer = setTimeout(take, left);
  });
  return slow;
}
