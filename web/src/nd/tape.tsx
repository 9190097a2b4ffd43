import { useComputed } from "@preact/signals";
import { DEG } from "../units";
import { type LayerProps, usePart } from "./layer";
import { Stroke } from "./stroke";
import { ink, LINES } from "./style";
import { polar, round } from "./view";

const TICK = { short: 10, long: 18, number: 38 } as const;
const HEADINGS = Array.from({ length: 72 }, (_, i) => i * 5);

/** The heading tape or rose: a tick each 5°, a number each 10°, a larger one each 30°. */
export function HeadingTape({ shown, view }: LayerProps) {
  const valid = usePart(shown, ({ now }) => now !== null);
  const radius = view.layout.value.tape;
  if (!valid.value) {
    return (
      <g class="nd-tape" transform={view.tapeTransform}>
        <circle class="nd-stroke" r={radius} stroke={ink("alert")} stroke-width={2} />
      </g>
    );
  }
  return (
    <g class="nd-tape" transform={view.tapeTransform}>
      <circle class="nd-stroke" r={radius} stroke={ink("scale")} stroke-width={2} />
      <Stroke d={ticks(radius)} line={LINES.tape} />
      {HEADINGS.filter((heading) => heading % 10 === 0).map((heading) => (
        <text
          key={heading}
          class="nd-text"
          fill={ink("scale")}
          font-size={heading % 30 === 0 ? 28 : 20}
          text-anchor="middle"
          transform={`rotate(${heading}) translate(0 ${-radius - TICK.number + 8})`}
        >
          {heading / 10}
        </text>
      ))}
    </g>
  );
}

function ticks(radius: number): string {
  return HEADINGS.map((heading) => {
    const length = heading % 10 === 0 ? TICK.long : TICK.short;
    const [x, y] = [Math.sin(heading * DEG), -Math.cos(heading * DEG)];
    const end = radius + length;
    return `M${round(x * radius)} ${round(y * radius)}L${round(x * end)} ${round(y * end)}`;
  }).join("");
}

/** The fixed mark over the nose. */
export function LubberLine({ view }: LayerProps) {
  const d = useComputed(() => {
    const { x, y } = polar(view.layout.value, 0, view.layout.value.tape);
    return `M${x} ${y - 24}V${y + 18}`;
  });
  return (
    <g class="nd-lubber">
      <Stroke d={d} line={{ colour: "ownship", width: 5, dash: "" }} />
    </g>
  );
}
