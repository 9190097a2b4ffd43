/** The primary flight display: attitude, bars, speed, level, heading, and how far apart the two are. */

import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { usePart } from "../nd/layer";
import { ink } from "../nd/style";
import { Panel, set } from "../parts";
import type { Session } from "../session";
import { isRecent, revertedAt } from "../store/states";
import type { Moment } from "../store/types";
import { FT, KT } from "../units";
import { Apart } from "./apart";
import { NOMINAL_ATTACK } from "./attitude";
import { Climb } from "./climb";
import { Bars, type Director } from "./director";
import { BALL, FACE, MIDDLE } from "./face";
import { createGauge, type Gauge } from "./gauge";
import { Still } from "./sheet";
import { BankScale, Sphere, Wings } from "./sphere";
import { type Bug, HeadingTape, LevelTape, SpeedTape } from "./tapes";
import { attitudeWords, barWords, createSpeaker } from "./words";
import "./pfd.css";

/** The bars flash for so long after guidance has given up what it commanded [s]. */
const FLASHING = 9;
const SMALL = "(max-width: 999px)";

export function PrimaryFlightDisplay({ session }: { session: Session }) {
  const gauge = useMemo(() => createGauge(session), [session]);
  useEffect(() => gauge.run(), [gauge]);
  const face = useRef<HTMLDivElement>(null);
  const isFlown = session.hands.value !== null;
  useEffect(() => {
    // on a small screen the stick hides what is below
    if (isFlown && matchMedia(SMALL).matches) face.current?.scrollIntoView();
  }, [isFlown]);
  const isShown = usePart(session.shown, ({ guided }) => guided !== null);
  const label = useComputed(() => {
    const { value: attitude } = gauge.read;
    return attitude === null ? "Primary flight display: no data." : attitudeWords(attitude);
  });
  return (
    <Panel
      name="pfd-panel"
      title="PFD"
      aside={
        <>
          <span class="pfd-note" title="No angle of attack is measured: a nominal one is taken.">
            pitch: path + {NOMINAL_ATTACK}°
          </span>
          {session.pfdOpen.value && (
            <button
              type="button"
              class="quiet"
              aria-label="Close the PFD"
              onClick={set(session.pfdOpen, false)}
            >
              ×
            </button>
          )}
        </>
      }
    >
      <div ref={face} class="pfd" role="img" aria-label={label}>
        {isShown.value ? <Face session={session} gauge={gauge} /> : <NoData />}
      </div>
      <BarSpeaker session={session} />
    </Panel>
  );
}

function NoData() {
  return (
    <Still name="nd-flash">
      <rect class="pfd-tape" {...BALL} stroke={ink("alert")} />
      <text
        class="nd-text"
        x={MIDDLE.x}
        y={MIDDLE.y + 14}
        font-size={40}
        text-anchor="middle"
        fill={ink("alert")}
      >
        ATT
      </text>
    </Still>
  );
}

/** The flight director as a moment shows it. */
export function directorOf({ now }: Moment): Director {
  if (now?.director !== true) return "off";
  return (now.bars?.length ?? 0) > 0 ? "seen" : "missing";
}

function Face({ session, gauge }: { session: Session; gauge: Gauge }) {
  const { flight, shown } = session;
  const director = useComputed(() => directorOf(flight.moment.value));
  const isReverted = useComputed(() => {
    const { value: moment } = flight.moment;
    return isRecent(moment, revertedAt(moment), FLASHING);
  });
  const planned = useComputed(() => {
    const { assignment, started } = flight.moment.value;
    return assignment?.max_bank_deg ?? started?.pursuer.max_bank_deg ?? null;
  });
  const most = useComputed(() => flight.moment.value.started?.pursuer.autopilot_bank_deg ?? null);
  const slowest = useComputed(() => {
    const least = flight.moment.value.now?.least_tas_mps ?? 0;
    return least > 0 ? Math.round(least / KT) : null;
  });
  const speed = useBug(() => {
    const { now, assignment } = flight.moment.value;
    const [selected] = assignment?.selected_tas_mps ?? [];
    const commanded = selected ?? now?.commanded_tas_mps;
    if (commanded === undefined) return null;
    const colour = selected === undefined ? "managed" : "selected";
    return { value: Math.round(commanded / KT), colour };
  });
  const level = useBug(() => {
    const { leader } = shown.picture.value;
    return leader === null
      ? null
      : { value: Math.round(leader.altitude_m / FT / 10) * 10, colour: "leader" };
  });
  const heading = useBug(() => {
    const { now } = flight.moment.value;
    if (now === null || now.reference.kind !== "hold_heading") return null;
    const isEngaged = now.engagement === "engaged";
    return {
      value: Math.round(now.reference.heading_deg),
      colour: isEngaged ? "managed" : "selected",
    };
  });
  const track = useComputed(() => Math.round(flight.moment.value.now?.pursuer.track_deg ?? 0));
  const limits = useComputed(() => flight.moment.value.started);
  const isKnown = usePart(shown, ({ leaderAge }) => leaderAge.numbers);
  const state = usePart(shown, ({ separation }) => separation.state);
  const least = usePart(shown, ({ closest, closestAtJoin }) => {
    const least = (closest ?? closestAtJoin)?.least;
    return least === undefined ? null : Math.round(least / 20) * 20; // to the tenth of a mile that is read
  });
  return (
    <>
      <Sphere gauge={gauge} />
      <BankScale planned={planned.value} most={most.value} />
      <Bars gauge={gauge} director={director.value} isReverted={isReverted.value} />
      <Wings />
      <SpeedTape gauge={gauge} bug={speed.value} least={slowest.value} />
      <LevelTape gauge={gauge} bug={level.value} />
      <Climb gauge={gauge} />
      <HeadingTape gauge={gauge} bug={heading.value} track={track.value} />
      <Apart
        gauge={gauge}
        minSeparation={limits.value?.min_separation_m ?? 0}
        slotDistance={limits.value?.slot_distance_m ?? 0}
        least={least.value}
        state={state.value}
        isKnown={isKnown.value}
      />
      <Modes session={session} />
    </>
  );
}

/** A mark that is drawn anew only when it is another. */
function useBug(find: () => Bug | null) {
  const key = useComputed(() => {
    const bug = find();
    return bug === null ? "" : `${bug.value} ${bug.colour}`;
  });
  return useComputed((): Bug | null => (key.value === "" ? null : find()));
}

/** What flies, in the first line: speed, path, and whose turn it is; the same as on the mode strip. */
function Modes({ session: { shown } }: { session: Session }) {
  const speed = useComputed(() => {
    const { now } = shown.picture.value.speed;
    return now === "" ? "" : `${now} ${shown.numbers.value.commandedSpeed}`;
  });
  const speedColour = usePart(shown, ({ speed }) => ink(speed.isSelected ? "selected" : "value"));
  const lateral = usePart(shown, ({ style }) => style?.lateral.now ?? "");
  const pilot = usePart(shown, ({ pilot }) => [pilot.now, pilot.next].filter(Boolean).join(" · "));
  const colour = usePart(shown, ({ pilot }) => ink(pilot.isLost ? "caution" : "label"));
  const isNew = usePart(shown, ({ pilot }) => pilot.boxed);
  return (
    <Still name="pfd-modes">
      <text class="nd-text" x={SPEED_AT} y={27} font-size={22} fill={speedColour}>
        {speed}
      </text>
      <text
        class="nd-text"
        x={MIDDLE.x}
        y={27}
        font-size={22}
        text-anchor="middle"
        fill={ink("value")}
      >
        {lateral}
      </text>
      <text
        class="nd-text"
        x={FACE.width - 14}
        y={27}
        font-size={22}
        text-anchor="end"
        fill={colour}
      >
        {pilot}
      </text>
      {isNew.value && (
        <rect class="pfd-new" x={FACE.width - 196} y={4} width={192} height={31} stroke={colour} />
      )}
      <path class="nd-rule" d={`M6 39H${FACE.width - 6}`} />
    </Still>
  );
}
const SPEED_AT = 12;

/** How to follow the bars, for those who listen, while the crew flies along them. */
function BarSpeaker({ session }: { session: Session }) {
  const words = useSignal("");
  const speak = useMemo(createSpeaker, []);
  const { now } = session.flight.read.value;
  const [bars] = now?.bars ?? [];
  const isAsked = now?.autopilot === false && bars !== undefined;
  words.value = isAsked ? speak(barWords(bars), performance.now()) : "";
  return (
    <p class="visually-hidden" role="status">
      {words}
    </p>
  );
}
