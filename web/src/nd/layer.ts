/** What every layer is a function of: the picture, its numbers, and the projection. */

import { type ReadonlySignal, useComputed } from "@preact/signals";
import type { Picture } from "../store/picture";
import type { Shown } from "../store/shown";
import type { PathSegment } from "../wire";
import type { View } from "./view";

export interface LayerProps {
  readonly shown: Shown;
  readonly view: View;
}

/** A path and the flight time at which its own clock shows 0 [s]. */
export interface TimedPath {
  readonly segments: readonly PathSegment[];
  readonly start: number;
}

/** One part of the picture: what is drawn from it is drawn anew only when it is another. */
export function usePart<T>({ picture }: Shown, part: (picture: Picture) => T): ReadonlySignal<T> {
  return useComputed(() => part(picture.value));
}
