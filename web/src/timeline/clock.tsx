/** The controls of time: play, step, rate, typed time, loop, and how far behind the newest the page is. */

import { type ReadonlySignal, useSignal } from "@preact/signals";
import { Choice, Icon } from "../parts";
import { type Actions, RATES, REPLAY_RATES, type Session } from "../session";
import { speedOf } from "../store/flight";
import { formatClock, readClockText } from "../units";
import type { Outline } from "./outline";

interface Props {
  readonly session: Session;
  readonly actions: Actions;
  readonly outline: ReadonlySignal<Outline | null>;
}

export function Clock({ session, actions, outline }: Props) {
  const { flight, recording } = session;
  const { clock } = flight;
  const stands = speedOf(flight) === 0;
  const none = outline.value === null;
  return (
    <div class="timeline-clock">
      <button
        type="button"
        class="quiet"
        disabled={none}
        aria-label="To the event before"
        title="To the event before ( , )"
        onClick={() => actions.toMark(-1)}
      >
        <Icon name="before" />
      </button>
      <button
        type="button"
        class="primary"
        disabled={none}
        aria-label={stands ? "Play" : "Pause"}
        title={`${stands ? "Play" : "Pause"} (Space)`}
        onClick={stands ? actions.play : actions.pause}
      >
        <Icon name={stands ? "play" : "pause"} />
      </button>
      <button
        type="button"
        class="quiet"
        disabled={none}
        aria-label="To the event after"
        title="To the event after ( . )"
        onClick={() => actions.toMark(1)}
      >
        <Icon name="after" />
      </button>
      <TimeField session={session} actions={actions} />
      <Rate session={session} actions={actions} />
      <Loop session={session} actions={actions} />
      <button
        type="button"
        class="quiet timeline-looping"
        disabled={none}
        aria-expanded={session.exportOpen.value}
        title="The display as a picture, the flight as a file"
        onClick={() => {
          session.exportOpen.value = !session.exportOpen.value;
        }}
      >
        EXPORT
      </button>
      {recording.value !== null ? (
        <span class="timeline-edge recorded">RECORDED</span>
      ) : clock.value.ended ? (
        <span class="timeline-edge">FLIGHT OVER</span>
      ) : (
        <Edge session={session} actions={actions} />
      )}
    </div>
  );
}

/** How fast it goes: a row of buttons where there is room, else a list. */
function Rate({ session, actions }: { session: Session; actions: Actions }) {
  const { source, clock } = session.flight;
  const isOwn = source.value.kind === "replay";
  const [rates, chosen] = isOwn
    ? [REPLAY_RATES, session.replayRate.value]
    : [RATES, clock.value.rate];
  return (
    <>
      <Choice
        label="Seconds of flight a second"
        kind="timeline-rates"
        options={rates}
        chosen={chosen}
        text={rateText}
        choose={actions.setRate}
      />
      <select
        class="timeline-rate"
        aria-label="Seconds of flight a second"
        value={String(chosen)}
        onChange={(event) => actions.setRate(Number(event.currentTarget.value))}
      >
        {rates.map((rate) => (
          <option key={rate} value={String(rate)}>
            {rateText(rate)}
          </option>
        ))}
      </select>
    </>
  );
}

function rateText(rate: number): string {
  const parts: Record<string, string> = { "0.25": "¼", "0.5": "½" };
  return `×${parts[String(rate)] ?? rate}`;
}

/** How far behind the newest the page is; a press goes there. */
function Edge({ session, actions }: { session: Session; actions: Actions }) {
  const { source, span, read } = session.flight;
  if (source.value.kind === "live") return <span class="timeline-edge live">LIVE</span>;
  const behind = Math.max(0, (span.value?.last ?? 0) - read.value.t);
  return (
    <button
      type="button"
      class="timeline-edge behind"
      title="Back to now (L)"
      onClick={actions.live}
    >
      −{formatClock(behind)} LIVE ▸
    </button>
  );
}

/** The flight time, typed as mm:ss, h:mm:ss or seconds. */
function TimeField({ session, actions }: { session: Session; actions: Actions }) {
  const { read, span } = session.flight;
  const [first, last] = [span.value?.first ?? 0, span.value?.last ?? 0];
  const end = Math.max(last, read.value.t); // the picture runs ahead of the newest that was heard
  const refusal = session.timeRefusal;
  const typed = useSignal<string | null>(null);
  const take = (field: HTMLInputElement) => {
    const t = readClockText(field.value);
    if (t === null) refusal.value = `“${field.value}” is no time: type 13:39, or 819 for seconds.`;
    else if (t < first || t > last)
      refusal.value = `The flight is known from ${formatClock(first)} to ${formatClock(last)}.`;
    else {
      refusal.value = "";
      actions.seek(t);
      typed.value = formatClock(t);
    }
  };
  return (
    <label class="timeline-time">
      <span class="visually-hidden">Flight time, mm:ss</span>
      <input
        type="text"
        inputMode="numeric"
        value={typed.value ?? formatClock(read.value.t)}
        size={7}
        aria-invalid={refusal.value !== ""}
        aria-describedby="time-refusal"
        onFocus={(event) => {
          typed.value = event.currentTarget.value; // the time goes on, what is typed stands
          event.currentTarget.select();
        }}
        onInput={(event) => {
          typed.value = event.currentTarget.value;
        }}
        onKeyDown={(event) => {
          if (event.key === "Enter") take(event.currentTarget);
        }}
        onChange={(event) => take(event.currentTarget)}
        onBlur={() => {
          typed.value = null;
        }}
      />
      <span class="of">of {formatClock(end)}</span>
      <span id="time-refusal" class="timeline-refusal" role="status">
        {refusal.value}
      </span>
    </label>
  );
}

function Loop({ session, actions }: { session: Session; actions: Actions }) {
  const { loop } = session.flight;
  const text =
    loop.value === null ? "LOOP" : `${formatClock(loop.value.from)}–${formatClock(loop.value.to)}`;
  return (
    <button
      type="button"
      class="quiet timeline-looping"
      aria-pressed={loop.value !== null}
      title="Show the last 30 s again and again; [ and ] set where it begins and ends"
      onClick={actions.toggleLoop}
    >
      {text}
    </button>
  );
}
