/** A flight in figures, each with its unit; of a flight that the autopilot flew only those that make sense. */

import type { History } from "../store/history";
import { GRAZE } from "../store/states";
import { formatClock, formatMiles } from "../units";
import type { FlownByHand } from "../wire";
import type { Fastest } from "./fastest";
import type { Losses } from "./losses";
import { type Flown, plansOf } from "./seconds";

export interface Figure {
  readonly label: string;
  readonly value: string;
  /** What else there is to say; "" for nothing. */
  readonly note: string;
  readonly tone: "plain" | "alert";
}

export function figuresOf(
  history: History,
  flown: Flown,
  losses: Losses,
  hand: FlownByHand | null,
  fastest: Fastest,
): Figure[] {
  const figure = (label: string, value: string, note = ""): Figure => ({
    label,
    value,
    note,
    tone: "plain",
  });
  const { joined, from } = flown;
  const forecast = flown.seconds.find(({ joins }) => joins !== null)?.joins;
  const over =
    fastest.joins === null || joined === null
      ? ""
      : `${seconds(joined - fastest.joins)} over the fastest path`;
  const replans = plansOf(history).filter(({ reason }) => reason !== "engaged").length;
  return [
    figure("Joined at", joined === null ? "not joined" : formatClock(joined), over),
    ...(forecast == null
      ? []
      : [
          figure(
            flown.byHand ? "The autopilot's join" : "Forecast of it",
            formatClock(forecast),
            `as of ${formatClock(from)}`,
          ),
        ]),
    figure(flown.byHand ? "Lost by hand" : "Lost since then", seconds(losses.flown)),
    ...(Math.round(losses.leader) === 0
      ? []
      : [
          figure(
            "By the leader's doing",
            `${seconds(Math.abs(losses.leader))} ${losses.leader > 0 ? "later" : "sooner"}`,
          ),
        ]),
    ...byHand(hand, figure),
    closest(history, flown),
    figure("Paths made anew", String(replans)),
  ];
}

function byHand(
  hand: FlownByHand | null,
  figure: (label: string, value: string, note?: string) => Figure,
): Figure[] {
  if (hand === null) return [figure("Flown by", "the autopilot")];
  const { time_s, with_bars_s, within_bar_s, tube_m } = hand;
  const share = with_bars_s > 0 ? Math.round((100 * within_bar_s) / with_bars_s) : null;
  return [
    figure("Flown by hand", formatClock(time_s), "min:s"),
    figure(
      "Within 2° of the bar",
      share === null ? "–" : `${share} %`,
      share === null ? "the bars were out of view" : `of ${formatClock(with_bars_s)}`,
    ),
    figure("Farthest beside the path", `${formatMiles(tube_m, 2)} NM`),
  ];
}

/** The least separation, and when. */
function closest(history: History, { seconds: all }: Flown): Figure {
  const least = all.reduce<{ t: number; d: number } | null>(
    (before, { t, sample: { separation_m: d } }) =>
      before === null || d < before.d ? { t, d } : before,
    null,
  );
  const { started } = history.knownAt(Number.POSITIVE_INFINITY);
  const min = started?.min_separation_m ?? 0;
  return {
    label: "Least separation",
    value: least === null ? "–" : `${formatMiles(least.d, 2)} NM`,
    note: least === null ? "" : `at ${formatClock(least.t)}, MIN ${formatMiles(min, 2)} NM`,
    tone: least !== null && least.d < min - GRAZE ? "alert" : "plain",
  };
}

function seconds(value: number): string {
  return `${String(Math.round(value)).replace("-", "−")} s`;
}
