/** One strip on a canvas, by uPlot: drawn anew when its lines change, and when the window moves. */

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Colour } from "../store/colours";
import { apartLabels, boundsOf, timesOf } from "./scale";
import type { Strip } from "./strips";

/** Margins beside the plot [px]: the axis on the left, what lines are called on the right. */
export const LEFT = 58;
export const RIGHT = 92;
const LABEL = 12;

/** A stretch of flight time [s]. */
export interface Window {
  readonly from: number;
  readonly to: number;
}

export interface Plot {
  /** Draws a strip between two times. */
  draw(strip: Strip, window: Window): void;
  resize(width: number): void;
  destroy(): void;
}

export function createPlot(
  place: HTMLElement,
  first: Strip,
  size: { readonly width: number; readonly height: number },
  ink: (colour: Colour) => string,
): Plot {
  let strip = first;
  let window: Window = { from: 0, to: 1 };
  const plot = new uPlot(optionsOf(), dataOf(first), place);

  function optionsOf(): uPlot.Options {
    const grid = { stroke: "#37424e", width: 1 };
    const axis = {
      stroke: ink("label"),
      font: "11px B612, sans-serif",
      grid,
      ticks: { show: false },
    };
    return {
      ...size,
      legend: { show: false },
      cursor: { show: false },
      padding: [6, RIGHT, 4, 0],
      scales: {
        x: { time: false, range: () => [window.from, window.to] },
        y: { range: () => boundsOf(strip, window.from, window.to) },
      },
      axes: [
        {
          ...axis,
          size: 0,
          splits: () => timesOf(window.from, window.to),
          values: (_, ticks) => ticks.map(() => ""),
        },
        {
          ...axis,
          size: LEFT,
          space: 26,
          values: (_, ticks) => ticks.map((value) => strip.format(value)),
        },
      ],
      series: [
        {},
        ...first.lines.map(({ colour, dash, isFaint }) => ({
          stroke: ink(colour),
          width: isFaint ? 1.25 : 1.75,
          alpha: isFaint ? 0.75 : 1,
          spanGaps: false,
          points: { show: false },
          ...(dash !== "" && { dash: dash.split(" ").map(Number) }),
        })),
      ],
      hooks: { draw: [drawLevels, drawLabels] },
    };
  }

  function drawLevels({ ctx, bbox, valToPos }: uPlot): void {
    ctx.save();
    ctx.setLineDash([4 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.lineWidth = devicePixelRatio;
    for (const { value, colour } of strip.levels) {
      const y = Math.round(valToPos(value, "y", true)) + 0.5;
      ctx.strokeStyle = ink(colour);
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
    }
    ctx.restore();
  }

  function drawLabels({ ctx, bbox, valToPos }: uPlot): void {
    const ratio = devicePixelRatio;
    const [top, bottom] = [bbox.top + 5 * ratio, bbox.top + bbox.height - 2 * ratio];
    const y = (value: number) => valToPos(value, "y", true);
    ctx.save();
    ctx.font = `${11 * ratio}px B612, sans-serif`;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    for (const { label, colour, at } of apartLabels(
      strip,
      window.to,
      y,
      LABEL * ratio,
      top,
      bottom,
    )) {
      ctx.fillStyle = ink(colour);
      ctx.fillText(label, bbox.left + bbox.width + 6 * ratio, at);
    }
    ctx.restore();
  }

  return {
    draw(next, over) {
      strip = next;
      window = over;
      plot.setData(dataOf(next));
    },
    resize: (width) => plot.setSize({ width, height: size.height }),
    destroy: () => plot.destroy(),
  };
}

function dataOf({ times, lines }: Strip): uPlot.AlignedData {
  return [[...times], ...lines.map(({ values }) => [...values])];
}
