/** Where a name fits best in a region: the middle of the longest line from west to east inside it. */

interface Place {
  readonly x_m: number;
  readonly y_m: number;
}

/** So many lines are tried across each polygon. */
const LINES = 7;

/** Polygons are outlines followed by their holes, closed; null where there is no inside. */
export function labelPlace(
  polygons: readonly (readonly (readonly Place[])[])[],
): (Place & { readonly width: number }) | null {
  let best: (Place & { width: number }) | null = null;
  for (const rings of polygons) {
    const [outline = []] = rings;
    const heights = outline.map(({ y_m }) => y_m);
    const [low, high] = [Math.min(...heights), Math.max(...heights)];
    for (let k = 1; k <= LINES; k += 1) {
      const y = low + ((high - low) * k) / (LINES + 1);
      const crossings = rings.flatMap((ring) => crossingsOf(ring, y)).sort((a, b) => a - b);
      for (let i = 0; i + 1 < crossings.length; i += 2) {
        const [from = 0, to = 0] = [crossings[i], crossings[i + 1]];
        if (best === null || to - from > best.width)
          best = { x_m: (from + to) / 2, y_m: y, width: to - from };
      }
    }
  }
  return best;
}

/** Where a closed ring crosses a height. */
function crossingsOf(ring: readonly Place[], y: number): number[] {
  return ring.slice(1).flatMap((b, i) => {
    const a = ring[i];
    if (a === undefined || a.y_m > y === b.y_m > y) return [];
    return [a.x_m + ((y - a.y_m) / (b.y_m - a.y_m)) * (b.x_m - a.x_m)];
  });
}
